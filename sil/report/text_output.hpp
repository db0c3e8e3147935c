// A result file that is being written. Nothing is lost silently: a full disk is an error at the latest on close().
#ifndef SEMTRACK_SIL_REPORT_TEXT_OUTPUT_HPP
#define SEMTRACK_SIL_REPORT_TEXT_OUTPUT_HPP

#include <cstdio>
#include <filesystem>
#include <memory>
#include <stdexcept>
#include <string>

namespace semtrack::sil {

class TextOutput {
public:
    /// Throws std::runtime_error with the file's name, as do all of these.
    explicit TextOutput(const std::filesystem::path& path)
        : name_(path.string()), file_(std::fopen(name_.c_str(), "wb")) {
        if (!file_) {
            fail();
        }
    }
    void write(const std::string& text) {
        if (std::fwrite(text.data(), 1, text.size(), file_.get()) != text.size()) {
            fail();
        }
    }
    void close() {
        const bool broken = std::ferror(file_.get()) != 0;
        if (std::fclose(file_.release()) != 0 || broken) {
            fail();
        }
    }
    [[nodiscard]] std::FILE* handle() { return file_.get(); }

private:
    struct Closer {
        void operator()(std::FILE* file) const { (void)std::fclose(file); }
    };
    [[noreturn]] void fail() const { throw std::runtime_error(name_ + ": cannot be written"); }

    std::string name_;
    std::unique_ptr<std::FILE, Closer> file_;
};

inline void write_file(const std::filesystem::path& path, const std::string& text) {
    TextOutput out(path);
    out.write(text);
    out.close();
}

}  // namespace semtrack::sil

#endif
