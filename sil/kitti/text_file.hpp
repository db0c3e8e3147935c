// Rows of numbers in text files: what is accepted and how it is refused (docs/formats.md). CRLF, tabs, blanks at row
// ends, a missing last newline and blank last lines are fine; numbers are parsed whole and without the locale.
#ifndef SEMTRACK_SIL_KITTI_TEXT_FILE_HPP
#define SEMTRACK_SIL_KITTI_TEXT_FILE_HPP

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace semtrack::sil {

struct TextRow {
    int line{0};  ///< from 1
    std::vector<std::string_view> words;
};

class TextFile {
public:
    /// Throws InputError when it cannot be read or starts with a byte-order mark. Rows keep pointing into this object.
    /// counted: the rows' numbers mean something (times, poses), so a blank line between rows is refused.
    /// separator: 0: blanks; a character: one field between any two of them, empty ones too, without blanks around.
    TextFile(const std::filesystem::path& path, bool counted, char separator = '\0');
    [[nodiscard]] const std::vector<TextRow>& rows() const { return rows_; }

    TextFile(const TextFile&) = delete;
    TextFile& operator=(const TextFile&) = delete;

    /// Whole, finite number; otherwise InputError "FILE:LINE: ...".
    [[nodiscard]] double number(const TextRow& row, std::size_t word) const;
    [[nodiscard]] int integer(const TextRow& row, std::size_t word) const;
    void require_words(const TextRow& row, std::size_t least, std::size_t most) const;
    [[noreturn]] void refuse(const TextRow& row, const std::string& what) const;
    [[noreturn]] void refuse_line(int line, const std::string& what) const;
    /// Something the file should hold was not found by its end.
    [[noreturn]] void refuse_end(const std::string& what) const;

private:
    std::string name_;
    std::string text_;
    int lines_{0};
    std::vector<TextRow> rows_;
};

/// A word of a file as it may stand in a message: printable and short, whatever the file holds.
[[nodiscard]] std::string quoted_word(std::string_view word);

}  // namespace semtrack::sil

#endif
