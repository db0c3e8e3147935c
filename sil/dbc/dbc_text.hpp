// The object list's DBC file, written from the table in src/publish: one source for encoder and receivers.
#ifndef SEMTRACK_SIL_DBC_DBC_TEXT_HPP
#define SEMTRACK_SIL_DBC_DBC_TEXT_HPP

#include <string>

#include "semtrack/can_encoder.hpp"

namespace semtrack::sil {

/// Whole text with newlines at the end of rows. Signals of a frame with several records end in _0, _1.
[[nodiscard]] std::string dbc_text(const CanConfig& config);

}  // namespace semtrack::sil

#endif
