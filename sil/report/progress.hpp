// One line of progress on a terminal; nothing anywhere else.
#ifndef SEMTRACK_SIL_REPORT_PROGRESS_HPP
#define SEMTRACK_SIL_REPORT_PROGRESS_HPP

namespace semtrack::sil {

class Progress {
public:
    /// wanted: false for --no-progress. Writes to stderr, only when it is a terminal.
    /// what: of what there are `total`.
    Progress(bool wanted, int total, const char* what = "frame");
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;
    void show(int done, int number);

private:
    bool on_;
    int total_;
    const char* what_;
    int last_tenth_percent_{-1};
};

}  // namespace semtrack::sil

#endif
