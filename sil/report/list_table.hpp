// list.csv: every signal of the published object list before quantisation, one column a signal, named as in the DBC.
#ifndef SEMTRACK_SIL_REPORT_LIST_TABLE_HPP
#define SEMTRACK_SIL_REPORT_LIST_TABLE_HPP

#include <cstdint>
#include <string>

#include "semtrack/can_encoder.hpp"
#include "semtrack/types.hpp"

namespace semtrack::sil {

[[nodiscard]] std::string list_header();
/// A row for the header's signals (object column empty), then one for each object of the list; a signal that is not
/// available, or of the other kind of row, is an empty field. The list is taken as sent at the image's time.
[[nodiscard]] std::string list_rows(int frame, const Output& output, CanDialect dialect, std::uint8_t list_counter);

}  // namespace semtrack::sil

#endif
