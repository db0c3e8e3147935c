#include "sil/kitti/text_file.hpp"

#include <clocale>

#include "sil/kitti/temp_files.hpp"

namespace semtrack::sil {
namespace {

class TextFiles : public TempFiles {};

std::vector<double> numbers(const std::filesystem::path& path) {
    const TextFile file(path, true);
    std::vector<double> out;
    for (const TextRow& row : file.rows()) {
        for (std::size_t i = 0; i < row.words.size(); ++i) {
            out.push_back(file.number(row, i));
        }
    }
    return out;
}

TEST_F(TextFiles, EveryAcceptedFormReadsAsThePlainOne) {
    const std::vector<double> plain = numbers(write("plain", "1 2.5\n-3e2 4\n"));
    ASSERT_EQ(plain, (std::vector<double>{1.0, 2.5, -300.0, 4.0}));
    EXPECT_EQ(numbers(write("crlf", "1 2.5\r\n-3e2 4\r\n")), plain);
    EXPECT_EQ(numbers(write("tabs", "\t1\t2.5 \n -3e2\t\t4\t \n")), plain);
    EXPECT_EQ(numbers(write("no_newline", "1 2.5\n-3e2 4")), plain);
    EXPECT_EQ(numbers(write("blank_last", "1 2.5\n-3e2 4\n\n")), plain);
    EXPECT_EQ(numbers(write("blank_last_crlf", "1 2.5\r\n-3e2 4\r\n \t\r\n")), plain);
    EXPECT_EQ(numbers(write("plus", "+1 2.5\n-3e2 +4\n")), plain);
}

TEST_F(TextFiles, BlankLineBetweenCountedRowsIsRefusedByItsLine) {
    const auto path = write("times.txt", "1\n\n2\n");
    EXPECT_REFUSED(TextFile(path, true), path.string() + ":2: ");
    EXPECT_EQ(TextFile(path, false).rows().size(), 2U);
    EXPECT_EQ(TextFile(path, false).rows()[1].line, 3);
    EXPECT_REFUSED(TextFile(write("first", "\n1\n"), true), ":1: ");
}

TEST_F(TextFiles, ByteOrderMarksAreRefusedByLine) {
    EXPECT_REFUSED(TextFile(write("utf8",
                                  "\xEF\xBB\xBF"
                                  "1\n"),
                            false),
                   "utf8:1: ");
    EXPECT_REFUSED(TextFile(write("utf16",
                                  "\xFF\xFE"
                                  "1"),
                            false),
                   "utf16:1: ");
    EXPECT_REFUSED(TextFile(write("utf16be",
                                  "\xFE\xFF"
                                  "1"),
                            false),
                   "utf16be:1: ");
}

TEST_F(TextFiles, WordsThatAreNoFiniteNumberAreRefusedByLine) {
    for (const char* word : {"nan", "inf", "-inf", "1,5", "1.5x", "x", "1e999", "0x10", "+-1", "--1", "1.2.3", "+"}) {
        EXPECT_REFUSED(numbers(write("bad", std::string("1\n") + word + "\n")), "bad:2: ");
    }
}

TEST_F(TextFiles, IntegersAreWhole) {
    const TextFile file(write("ints", "1 2.0 2.5 3000000000 -7\n"), false);
    const TextRow& row = file.rows()[0];
    EXPECT_EQ(file.integer(row, 0), 1);
    EXPECT_EQ(file.integer(row, 1), 2);
    EXPECT_EQ(file.integer(row, 4), -7);
    EXPECT_REFUSED(file.integer(row, 2), "ints:1: ");
    EXPECT_REFUSED(file.integer(row, 3), "ints:1: ");
}

TEST_F(TextFiles, MessagesStayPrintableAndShort) {
    const std::string what = refusal([&] { (void)numbers(write("binary", "\x01\x1b[31m" + std::string(500, 'z'))); });
    EXPECT_LT(what.size(), at("binary").string().size() + 100);
    for (const char c : what) {
        EXPECT_TRUE(c >= ' ' && c <= '~');
    }
}

TEST_F(TextFiles, MissingFilesAndFoldersAreRefusedByName) {
    EXPECT_REFUSED(TextFile(at("nowhere.txt"), false), at("nowhere.txt").string());
    EXPECT_REFUSED(TextFile(root_, false), root_.string());
    EXPECT_TRUE(TextFile(write("empty", ""), true).rows().empty());
}

TEST_F(TextFiles, TheLocaleDoesNotMatter) {
    const char* old = std::setlocale(LC_ALL, nullptr);
    const std::string saved = old == nullptr ? "C" : old;
    (void)std::setlocale(LC_ALL, "de_DE.UTF-8");  // where it is installed: a decimal comma
    EXPECT_EQ(numbers(write("plain", "1.25\n")), std::vector<double>{1.25});
    EXPECT_REFUSED(numbers(write("comma", "1,25\n")), "comma:1: ");
    (void)std::setlocale(LC_ALL, saved.c_str());
}

TEST_F(TextFiles, FieldsBetweenSeparatorsMayBeEmpty) {
    const auto path = write("a.csv", "frame, x ,y\r\n1,,2.5\n3,4,\n");
    const TextFile file(path, false, ',');
    ASSERT_EQ(file.rows().size(), 3U);
    EXPECT_EQ(file.rows()[0].words[1], "x");
    ASSERT_EQ(file.rows()[1].words.size(), 3U);
    EXPECT_EQ(file.rows()[1].words[1], "");
    EXPECT_EQ(file.number(file.rows()[1], 2), 2.5);
    ASSERT_EQ(file.rows()[2].words.size(), 3U);
    EXPECT_EQ(file.rows()[2].words[2], "");
}

}  // namespace
}  // namespace semtrack::sil
