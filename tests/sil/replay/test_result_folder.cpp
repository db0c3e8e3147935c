#include "sil/result_folder.hpp"

#include <gtest/gtest.h>
#include <unistd.h>

#include <filesystem>
#include <string>

#include "sil/report/text_output.hpp"
#include "sil/sequence.hpp"

namespace semtrack::sil {
namespace {

namespace fs = std::filesystem;

class ResultFolders : public testing::Test {
protected:
    ResultFolders() : base_(fs::temp_directory_path() / ("semtrack_results_" + std::to_string(::getpid()))) {
        fs::remove_all(base_);
        fs::create_directories(base_);
    }
    ~ResultFolders() override { fs::remove_all(base_); }
    fs::path base_;
};

TEST_F(ResultFolders, WithoutCommitAFolderThatWasMadeIsGoneAgain) {
    {
        ResultFolder folder(base_ / "out");
        write_file(folder.work() / "ego.txt", "new");
    }
    EXPECT_FALSE(fs::exists(base_ / "out"));
}

TEST_F(ResultFolders, WithoutCommitOldResultsAreUntouched) {
    write_file(base_ / "ego.txt", "old");
    {
        ResultFolder folder(base_);
        write_file(folder.work() / "ego.txt", "something new");
    }
    EXPECT_EQ(fs::file_size(base_ / "ego.txt"), 3U);
    EXPECT_EQ(std::distance(fs::directory_iterator(base_), fs::directory_iterator()), 1);
}

TEST_F(ResultFolders, CommitReplacesOldResultsAndLeavesForeignFiles) {
    fs::create_directories(base_ / "pictures");
    for (const char* name :
         {"ego.txt", "points.csv", "notes.md", "pictures/000001.png", "pictures/birdseye.png", "pictures/mine.png"}) {
        write_file(base_ / name, "old");
    }
    {
        ResultFolder folder(base_);
        write_file(folder.work() / "ego.txt", "newer");
        fs::create_directories(folder.work() / "pictures");
        write_file(folder.work() / "pictures" / "000002.png", "newer");
        folder.commit();
    }
    EXPECT_EQ(fs::file_size(base_ / "ego.txt"), 5U);
    EXPECT_FALSE(fs::exists(base_ / "points.csv"));
    EXPECT_TRUE(fs::exists(base_ / "notes.md"));
    EXPECT_FALSE(fs::exists(base_ / "pictures" / "000001.png"));
    EXPECT_FALSE(fs::exists(base_ / "pictures" / "birdseye.png"));
    EXPECT_TRUE(fs::exists(base_ / "pictures" / "mine.png"));
    EXPECT_TRUE(fs::exists(base_ / "pictures" / "000002.png"));
}

TEST_F(ResultFolders, ARunWithoutPicturesLeavesNoOldOnes) {
    fs::create_directories(base_ / "pictures");
    write_file(base_ / "pictures" / "000001.png", "old");
    {
        ResultFolder folder(base_);
        folder.commit();
    }
    EXPECT_FALSE(fs::exists(base_ / "pictures"));
}

TEST_F(ResultFolders, AFileInTheWayIsRefusedByName) {
    write_file(base_ / "file", "mine");
    for (const fs::path& path : {base_ / "file", base_ / "file" / "out"}) {
        try {
            const ResultFolder folder(path);
            FAIL() << path;
        } catch (const InputError& error) {
            EXPECT_NE(std::string(error.what()).find(path.string()), std::string::npos);
        }
    }
    EXPECT_EQ(fs::file_size(base_ / "file"), 4U);
}

}  // namespace
}  // namespace semtrack::sil
