// Rows "bytes name" of the parts of a Tracker, then its own; which capacities is the compile definitions' matter.
#include <cstdio>

#include "pipeline/tracker_memory.hpp"

int main() {
    for (const semtrack::TrackerMemory::Part& part : semtrack::TrackerMemory::parts()) {
        std::printf("%zu %s\n", part.bytes, part.name);
    }
    std::printf("%zu whole state\n%zu storage of a Tracker\n", semtrack::TrackerMemory::kTotal,
                sizeof(semtrack::Tracker));
    return 0;
}
