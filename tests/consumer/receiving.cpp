// A receiving ECU's program: a frame of somebody else's is no list.
#include "semtrack/can_receiver.hpp"

int main() {
    static semtrack::CanReceiver receiver{};
    static semtrack::ReceivedList list{};
    semtrack::CanFrame frame{};
    frame.id = 0x7FF;
    return receiver.take(frame, 0, list) == semtrack::FrameResult::kListComplete ? 1 : 0;
}
