// The folder of a run's results: written beside the old ones and put in their place only when the run succeeds.
#ifndef SEMTRACK_SIL_RESULT_FOLDER_HPP
#define SEMTRACK_SIL_RESULT_FOLDER_HPP

#include <filesystem>

namespace semtrack::sil {

class ResultFolder {
public:
    /// Creates DIR and a working folder in it. InputError when that or writing a file there is impossible.
    explicit ResultFolder(const std::filesystem::path& dir);
    /// Without commit(): the working folder goes, and DIR too when it was made here; old results stay as they are.
    ~ResultFolder();
    ResultFolder(const ResultFolder&) = delete;
    ResultFolder& operator=(const ResultFolder&) = delete;

    /// Where to write.
    [[nodiscard]] const std::filesystem::path& work() const { return work_; }
    /// Removes a former run's results and moves the new ones into their place. Foreign files stay.
    void commit();

private:
    std::filesystem::path dir_;
    std::filesystem::path work_;
    bool created_{false};
    bool committed_{false};
};

}  // namespace semtrack::sil

#endif
