// What the optimisation of one object changes.
#ifndef SEMTRACK_ESTIMATE_OBJECT_OBJECT_VARIABLES_HPP
#define SEMTRACK_ESTIMATE_OBJECT_OBJECT_VARIABLES_HPP

#include <array>

#include "model/object_window.hpp"

namespace semtrack {

struct ObjectVariables {
    std::array<ObjectState, kObjectWindow> state{};
    Vec3 size_m{Vec3::Ones()};
    std::array<Vec3, kMaxObjectFeatures> f_o{};  // by slot
};

}  // namespace semtrack

#endif
