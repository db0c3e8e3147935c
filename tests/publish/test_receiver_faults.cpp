// Every single fault of a list is noticed, over all its frames and bits; a list with a fault never comes out.
#include "support/receiver_rig.hpp"

namespace semtrack {
namespace {

using test::Frames;

class ReceiverFaults : public test::ReceiverRig {
protected:
    /// Every fault is one of one list: begun and given up, or never begun.
    [[nodiscard]] std::uint32_t lost_lists() const { return counters().lists_broken + counters().lists_missed; }
};

TEST_P(ReceiverFaults, EveryLostFrameLosesItsListAndNoOther) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = 0; i < list.size(); ++i) {
        Frames lossy = list;
        lossy.erase(lossy.begin() + static_cast<std::ptrdiff_t>(i));
        EXPECT_TRUE(disturb(before, lossy, after).empty()) << "frame " << i;
        EXPECT_EQ(lost_lists(), 1U) << "frame " << i;
        EXPECT_EQ(counters().lists_complete, 2U);
        EXPECT_GE(counters().frames[static_cast<std::size_t>(E2eState::kOkSomeLost)], 1U) << "frame " << i;
    }
    EXPECT_TRUE(disturb(before, {}, after).empty());
    EXPECT_EQ(counters().lists_missed, 1U) << "a whole list that got lost";
}

TEST_P(ReceiverFaults, EverySwappedPairOfFramesLosesTheList) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t j = i + 1; j < list.size(); ++j) {
            Frames swapped = list;
            std::swap(swapped[i], swapped[j]);
            EXPECT_TRUE(disturb(before, swapped, after).empty()) << i << " " << j;
            EXPECT_GE(lost_lists(), 1U) << i << " " << j;
        }
    }
}

TEST_P(ReceiverFaults, EveryFrameThatComesTwiceIsRefusedWithTheListItCameIn) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::size_t j = i + 1; j <= list.size(); ++j) {  // again at once, or later
            Frames twice = list;
            twice.insert(twice.begin() + static_cast<std::ptrdiff_t>(j), list[i]);
            const std::vector<int> whole = disturb(before, twice, after);
            const bool behind = j == list.size();  // the list was whole before
            EXPECT_EQ(whole.size(), behind ? 1U : 0U) << i << " " << j;
            const auto& states = counters().frames;
            EXPECT_EQ(states[static_cast<std::size_t>(E2eState::kRepeated)] +
                              states[static_cast<std::size_t>(E2eState::kWrongSequence)] +
                              counters().frames_out_of_place >
                          0U,
                      true)
                << i << " " << j;
        }
    }
}

TEST_P(ReceiverFaults, EveryFlippedBitOfEveryFrameLosesTheList) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    int flips = 0;
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (unsigned bit = 0; bit < 8U * list[i].length; ++bit, ++flips) {
            Frames flipped = list;
            std::uint8_t& byte = flipped[i].data[bit / 8U];
            byte = static_cast<std::uint8_t>(byte ^ (1U << (bit % 8U)));
            ASSERT_TRUE(disturb(before, flipped, after).empty()) << "frame " << i << " bit " << bit;
            ASSERT_EQ(errors(), 1U) << "frame " << i << " bit " << bit;
            ASSERT_EQ(lost_lists(), 1U) << "frame " << i << " bit " << bit;
        }
    }
    EXPECT_EQ(flips, dialect().fd ? 8 * (24 + 2 * 64) : 8 * 8 * 25);
}

TEST_P(ReceiverFaults, FrameUnderAnotherIdOrOfAnotherFormLosesTheList) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = 0; i < list.size(); ++i) {
        for (std::uint32_t m = 0; m < dialect().messages; ++m) {
            Frames masked = list;
            masked[i].id = config_.can.base_id + m;
            EXPECT_EQ(disturb(before, masked, after).size(), masked[i].id == list[i].id ? 1U : 0U) << i << " " << m;
        }
        for (int form = 0; form < 4; ++form) {
            Frames other = list;
            other[i].id += form == 0 ? 0x40U : 0U;
            other[i].extended = form == 1;
            other[i].fd = other[i].fd != (form == 2);
            other[i].length = static_cast<std::uint8_t>(other[i].length - (form == 3 ? 1U : 0U));
            EXPECT_TRUE(disturb(before, other, after).empty()) << "frame " << i << " form " << form;
            EXPECT_EQ(lost_lists(), 1U) << "frame " << i << " form " << form;
        }
    }
}

TEST_P(ReceiverFaults, ForeignFrameWithinAListLosesIt) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = 1; i < list.size(); ++i) {
        for (const CanFrame& victim : {list[i], list.front(), list.back()}) {
            CanFrame foreign = victim;  // somebody who knows the id and the length, but not the data id
            for (std::size_t k = 0; k < foreign.length; ++k) {
                foreign.data[k] = static_cast<std::uint8_t>(37U * k + i);
            }
            Frames disturbed = list;
            disturbed.insert(disturbed.begin() + static_cast<std::ptrdiff_t>(i), foreign);
            EXPECT_TRUE(disturb(before, disturbed, after).empty()) << i;
            EXPECT_EQ(errors(), 1U) << i;
        }
    }
}

TEST_P(ReceiverFaults, FrameWithAnotherIndexLosesTheListThoughItsProtectionIsRight) {
    const Frames before = next_list();
    const Frames list = next_list();
    const Frames after = next_list();
    for (std::size_t i = static_cast<std::size_t>(dialect().header_messages); i < list.size(); ++i) {
        for (std::uint64_t index = 0; index < 16; ++index) {
            Frames wrong = list;
            put_bits(wrong[i].data, record_index_bit(dialect()), kRecordIndexBits, index);
            protect(wrong[i], counter_of(list[i]));
            const bool right = wrong[i].data == list[i].data;
            EXPECT_EQ(disturb(before, wrong, after).size(), right ? 1U : 0U) << i << " " << index;
            EXPECT_EQ(counters().frames_out_of_place > 0U, !right) << i << " " << index;
        }
    }
}

TEST_P(ReceiverFaults, TwoListsNeverMix) {
    const Frames before = next_list();
    const Frames first = next_list();
    const Frames second = next_list();
    const Frames after = next_list();
    for (std::size_t k = 1; k < first.size(); ++k) {
        const auto at = static_cast<std::ptrdiff_t>(k);
        Frames mixed(first.begin(), first.begin() + at);
        mixed.insert(mixed.end(), second.begin() + at, second.end());
        EXPECT_TRUE(disturb(before, mixed, after).empty()) << k;
        // ... also when somebody makes every counter fit
        for (std::size_t i = k; i < mixed.size(); ++i) {
            protect(mixed[i], counter_of(first[i]));
        }
        EXPECT_TRUE(disturb(before, mixed, after).empty()) << k;
        EXPECT_GE(counters().frames_out_of_place, 1U) << k;
    }
}

TEST_P(ReceiverFaults, OldListSentAgainNeverComesOutAgain) {
    std::vector<Frames> lists;
    for (int k = 0; k < 4; ++k) {
        lists.push_back(next_list());
    }
    for (const Frames& old : {lists[0], lists[1], lists[2]}) {
        EXPECT_EQ(receiver_.init(config_), Status::kOk);
        EXPECT_EQ(receive(lists[0]), std::vector<int>{0});
        EXPECT_EQ(receive(lists[1]), std::vector<int>{1});
        EXPECT_EQ(receive(lists[2]), std::vector<int>{2});
        EXPECT_TRUE(receive(old).empty());
    }
}

TEST_P(ReceiverFaults, ListOfAnotherVersionOrWithAnImpossibleCountIsRefused) {
    const MessageSpec& header = dialect().message[0];
    int bit = first_signal_bit(dialect(), header);
    for (int i = 0; i < header.signals; ++i) {
        const SignalId id = header.signal[static_cast<std::size_t>(i)];
        const int length = signal_spec(id).length;
        const bool version = id == SignalId::kProtocolVersion;
        if (version || id == SignalId::kObjectCount) {
            for (std::uint64_t raw = 0; raw <= all_ones(length); ++raw) {
                Frames list = next_list();
                put_bits(list[0].data, bit, length, raw);
                protect(list[0], counter_of(list[0]));
                // A sender that vouches for a shorter list gets it; what follows is out of place. 1 and 4 of FD's pairs
                // do not agree with the slots in use.
                const bool shorter = raw == 0U || (dialect().fd && raw == 2U);
                const bool right = version ? raw == kProtocolVersion : raw == 3U || shorter;
                EXPECT_EQ(receive(list).size(), right ? 1U : 0U) << signal_spec(id).name << " " << raw;
            }
        }
        bit += length;
    }
    EXPECT_GT(counters().lists_refused, 15U);
}

TEST_P(ReceiverFaults, UnknownCodesAreNotValidAndChangeNothingElse) {
    const int first = dialect().header_messages;
    for (int k = 0; k < dialect().messages; ++k) {
        const MessageSpec& m = dialect().message[static_cast<std::size_t>(k)];
        int bit = first_signal_bit(dialect(), m);
        for (int i = 0; i < m.signals; ++i) {
            const SignalId id = m.signal[static_cast<std::size_t>(i)];
            const SignalSpec& s = signal_spec(id);
            if (s.values != nullptr && id != SignalId::kSaturated && id != SignalId::kHeaderSaturated) {
                Frames list = next_list();
                for (CanFrame& f : list) {
                    const bool of_object_0 = k >= first && get_bits(f.data, record_index_bit(dialect()), 4) == 0U;
                    if (f.id == config_.can.base_id + static_cast<std::uint32_t>(k) && (k < first || of_object_0)) {
                        put_bits(f.data, bit, s.length, max_raw(s));
                        protect(f, counter_of(f));
                    }
                }
                ASSERT_EQ(receive(list).size(), 1U) << s.name;
                const ReceivedObject& o = list_->objects[0];
                const int valid = list_->ego_status.valid + list_->ego_degraded.valid + list_->no_right_image.valid +
                                  list_->no_detections.valid + list_->road_not_plane.valid + o.object_class.valid +
                                  o.status.valid + o.movement.valid + o.truncated.valid + o.occlusion.valid +
                                  o.reference_point.valid;
                EXPECT_EQ(valid, 10) << s.name;
            }
            bit += s.length;
        }
    }
}

TEST_P(ReceiverFaults, AnyBytesAreSurvivedAndNeverBecomeAList) {
    Rng rng(3);
    const Frames list = next_list();
    std::vector<std::uint8_t> counter(16, 0);
    int whole = 0;
    for (int k = 0; k < 200000; ++k) {
        CanFrame f = list[static_cast<std::size_t>(rng.below(static_cast<int>(list.size())))];
        const std::uint32_t kind = rng.next() % 8U;
        f.id = kind == 0U ? rng.next() : config_.can.base_id + rng.next() % 16U;
        f.extended = rng.next() % 16U == 0U;
        f.fd = rng.next() % 16U == 0U ? !f.fd : f.fd;
        f.length = rng.next() % 4U == 0U ? static_cast<std::uint8_t>(rng.next()) : f.length;
        for (std::uint8_t& byte : f.data) {
            byte = static_cast<std::uint8_t>(rng.next());
        }
        const std::uint32_t m = f.id - config_.can.base_id;
        if (kind > 3U && m < dialect().messages) {  // protected as if by the sender
            f.length = dialect().message[m].length;
            f.fd = dialect().fd;
            protect(f, counter[m]);
            counter[m] = static_cast<std::uint8_t>((counter[m] + 1U) % (dialect().fd ? 256U : 15U));
        }
        now_us_ += static_cast<std::int64_t>(rng.next() % 1000U) * (rng.next() % 1000U == 0U ? 10000 : 1);
        whole += receiver_.take(f, now_us_, *list_) == FrameResult::kListComplete ? 1 : 0;
    }
    // Right by themselves and without objects: in the FD dialect such a header is a list (version 1, count 0).
    EXPECT_LT(whole, dialect().fd ? 200 : 1);
    EXPECT_GT(errors(), 1000U);
    EXPECT_EQ(static_cast<int>(counters().lists_complete), whole);
}

INSTANTIATE_TEST_SUITE_P(Dialects, ReceiverFaults, ::testing::Values(CanDialect::kFd, CanDialect::kClassic),
                         test::dialect_name);

}  // namespace
}  // namespace semtrack
