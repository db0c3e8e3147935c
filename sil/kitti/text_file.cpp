#include "sil/kitti/text_file.hpp"

#include <charconv>
#include <cmath>
#include <fstream>
#include <iterator>

#include "sil/sequence.hpp"

namespace semtrack::sil {

namespace {

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

std::vector<std::string_view> split(std::string_view line) {
    std::vector<std::string_view> words;
    std::size_t i = 0;
    while (i < line.size()) {
        while (i < line.size() && is_blank(line[i])) {
            ++i;
        }
        std::size_t end = i;
        while (end < line.size() && !is_blank(line[end])) {
            ++end;
        }
        if (end > i) {
            words.push_back(line.substr(i, end - i));
        }
        i = end;
    }
    return words;
}

std::string_view trimmed(std::string_view word) {
    while (!word.empty() && is_blank(word.front())) {
        word.remove_prefix(1);
    }
    while (!word.empty() && is_blank(word.back())) {
        word.remove_suffix(1);
    }
    return word;
}

std::vector<std::string_view> split_at(std::string_view line, char separator) {
    std::vector<std::string_view> fields;
    line = trimmed(line);
    while (!line.empty()) {
        const std::size_t end = line.find(separator);
        fields.push_back(trimmed(line.substr(0, end)));
        if (end == std::string_view::npos) {
            break;
        }
        line.remove_prefix(end + 1);
        if (line.empty()) {
            fields.emplace_back();
        }
    }
    return fields;
}

}  // namespace

std::string quoted_word(std::string_view word) {
    constexpr std::size_t kLongest = 40;
    std::string out = "'";
    for (const char c : word.substr(0, kLongest)) {
        out += c >= ' ' && c <= '~' ? c : '?';
    }
    return out + (word.size() > kLongest ? "...'" : "'");
}

TextFile::TextFile(const std::filesystem::path& path, bool counted, char separator) : name_(path.string()) {
    std::ifstream in(path, std::ios::binary);
    if (!in || std::filesystem::is_directory(path)) {
        throw InputError(name_ + ": cannot be read");
    }
    text_.assign(std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>());
    if (text_.compare(0, 3, "\xEF\xBB\xBF") == 0 || text_.compare(0, 2, "\xFF\xFE") == 0 ||
        text_.compare(0, 2, "\xFE\xFF") == 0) {
        refuse_line(1, "starts with a byte-order mark");
    }
    int line = 0;
    int first_blank = 0;
    std::size_t begin = 0;
    const std::string_view text(text_);
    while (begin < text.size()) {
        std::size_t end = text.find('\n', begin);
        end = end == std::string_view::npos ? text.size() : end;
        ++line;
        const std::string_view here = text.substr(begin, end - begin);
        TextRow row{line, separator == '\0' ? split(here) : split_at(here, separator)};
        if (row.words.empty()) {
            first_blank = first_blank == 0 ? line : first_blank;
        } else {
            if (counted && first_blank != 0) {
                refuse_line(first_blank, "a blank line between rows");
            }
            rows_.push_back(std::move(row));
        }
        begin = end + 1;
    }
    lines_ = line;
}

void TextFile::refuse_line(int line, const std::string& what) const {
    throw InputError(name_ + ":" + std::to_string(line) + ": " + what);
}

void TextFile::refuse(const TextRow& row, const std::string& what) const {
    refuse_line(row.line, what);
}

void TextFile::refuse_end(const std::string& what) const {
    refuse_line(lines_ > 0 ? lines_ : 1, what);
}

void TextFile::require_words(const TextRow& row, std::size_t least, std::size_t most) const {
    if (row.words.size() < least || row.words.size() > most) {
        refuse(row, "has " + std::to_string(row.words.size()) + " values instead of " + std::to_string(least));
    }
}

double TextFile::number(const TextRow& row, std::size_t word) const {
    std::string_view w = row.words.at(word);
    if (w.size() > 1 && w[0] == '+' && w[1] != '-') {
        w.remove_prefix(1);
    }
    double value = 0.0;
    const auto [end, error] = std::from_chars(w.data(), w.data() + w.size(), value);
    if (error != std::errc{} || end != w.data() + w.size() || !std::isfinite(value)) {
        refuse(row, quoted_word(row.words[word]) + " is not a finite number");
    }
    return value;
}

int TextFile::integer(const TextRow& row, std::size_t word) const {
    const double value = number(row, word);
    if (std::floor(value) != value || std::fabs(value) > 2e9) {
        refuse(row, quoted_word(row.words[word]) + " is not a whole number");
    }
    return static_cast<int>(value);
}

}  // namespace semtrack::sil
