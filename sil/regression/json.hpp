// The JSON of scenario files and results: keys stay in the order in which they were written.
#ifndef SEMTRACK_SIL_REGRESSION_JSON_HPP
#define SEMTRACK_SIL_REGRESSION_JSON_HPP

#include <nlohmann/json.hpp>

namespace semtrack::sil {

using Json = nlohmann::ordered_json;

}  // namespace semtrack::sil

#endif
