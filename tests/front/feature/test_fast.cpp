// FAST-9 corners and their selection.
#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <set>
#include <vector>

#include "front/feature/fast.hpp"
#include "front/feature/select.hpp"
#include "math/rng.hpp"

namespace semtrack {
namespace {

struct Picture {
    int width;
    int height;
    std::vector<std::uint8_t> pixels;

    Picture(int w, int h, std::uint8_t grey)
        : width(w), height(h), pixels(static_cast<std::size_t>(w) * static_cast<std::size_t>(h), grey) {}
    std::uint8_t& at(int x, int y) { return pixels[static_cast<std::size_t>(y * width + x)]; }
    void rectangle(int x0, int y0, int x1, int y1, std::uint8_t grey) {
        for (int y = y0; y < y1; ++y) {
            for (int x = x0; x < x1; ++x) {
                at(x, y) = grey;
            }
        }
    }
    [[nodiscard]] ImageView view() const { return {pixels.data(), width, height, width}; }
};

Picture noise(int w, int h, std::uint32_t seed) {
    Picture p(w, h, 0);
    Rng rng(seed);
    for (std::uint8_t& x : p.pixels) {
        x = static_cast<std::uint8_t>(rng.below(256));
    }
    return p;
}

/// By the definition: the largest threshold at which 9 neighbours in a row are all brighter or all darker; 0: none.
int reference_score(Picture& p, int x, int y) {
    constexpr std::array<std::array<int, 2>, 16> kCircle{{{0, -3},
                                                          {1, -3},
                                                          {2, -2},
                                                          {3, -1},
                                                          {3, 0},
                                                          {3, 1},
                                                          {2, 2},
                                                          {1, 3},
                                                          {0, 3},
                                                          {-1, 3},
                                                          {-2, 2},
                                                          {-3, 1},
                                                          {-3, 0},
                                                          {-3, -1},
                                                          {-2, -2},
                                                          {-1, -3}}};
    int best = 0;
    for (std::size_t start = 0; start < 16; ++start) {
        int brighter = 255;
        int darker = 255;
        for (std::size_t k = 0; k < 9; ++k) {
            const auto& c = kCircle[(start + k) % 16];
            const int difference = p.at(x + c[0], y + c[1]) - p.at(x, y);
            brighter = std::min(brighter, difference);
            darker = std::min(darker, -difference);
        }
        best = std::max({best, brighter - 1, darker - 1});
    }
    return best;
}

std::vector<Corner> all(const CornerGrid& grid) {
    std::vector<Corner> out;
    for (int c = 0; c < grid.cells(); ++c) {
        for (int i = 0; i < grid.count(c); ++i) {
            out.push_back(grid.corner(c, i));
        }
    }
    return out;
}

class Fast : public ::testing::Test {
protected:
    std::unique_ptr<FastDetector> detector_ = std::make_unique<FastDetector>();
    std::unique_ptr<CornerGrid> grid_ = std::make_unique<CornerGrid>();
};

TEST_F(Fast, EveryCornerHasTheScoreOfTheDefinition) {
    Picture p = noise(200, 120, 3);
    ASSERT_EQ(detector_->detect(p.view(), 20, 5, *grid_), Status::kOk);
    const std::vector<Corner> corners = all(*grid_);
    ASSERT_GT(corners.size(), 100U);
    for (const Corner& c : corners) {
        EXPECT_EQ(c.score, reference_score(p, c.x, c.y)) << c.x << " " << c.y;
        EXPECT_GE(c.score, 20);
    }
}

TEST_F(Fast, NoCornerIsMissedOrInventedWhateverTheImagesWidthAndTheThreshold) {
    constexpr int kMargin = 5;
    int corners = 0;
    for (int width = 2 * kMargin + 16; width < 64; ++width) {
        Picture p = noise(width, 24, static_cast<std::uint32_t>(width));
        const int threshold = width % 3 == 0 ? 1 : width % 3 == 1 ? 30 : 80;
        std::vector<int> score(static_cast<std::size_t>(width) * 24U, 0);
        const auto at = [&](int x, int y) -> int& { return score[static_cast<std::size_t>(y * width + x)]; };
        for (int y = kMargin; y < 24 - kMargin; ++y) {
            for (int x = kMargin; x < width - kMargin; ++x) {
                const int s = reference_score(p, x, y);
                at(x, y) = s >= threshold ? s : 0;
            }
        }
        std::set<std::array<int, 3>> expected;
        for (int y = kMargin; y < 24 - kMargin; ++y) {
            for (int x = kMargin; x < width - kMargin; ++x) {
                bool largest = at(x, y) > 0;
                for (int k = 0; k < 9; ++k) {
                    const int other = at(x + k % 3 - 1, y + k / 3 - 1);
                    largest = largest && (k < 4 ? other < at(x, y) : other <= at(x, y));
                }
                if (largest) {
                    expected.insert({x, y, at(x, y)});
                }
            }
        }
        ASSERT_EQ(detector_->detect(p.view(), threshold, kMargin, *grid_), Status::kOk);
        std::set<int> full;  // cells that may have dropped some
        for (int cell = 0; cell < grid_->cells(); ++cell) {
            if (grid_->count(cell) == CornerGrid::kPerCell) {
                full.insert(cell);
            }
        }
        std::size_t found = 0;
        for (const Corner& c : all(*grid_)) {
            EXPECT_EQ(expected.count({c.x, c.y, c.score}), 1U) << width << ": " << c.x << " " << c.y;
            ++found;
        }
        EXPECT_TRUE(found == expected.size() || (!full.empty() && found < expected.size())) << width;
        corners += static_cast<int>(found);
    }
    EXPECT_GT(corners, 300);
}

TEST_F(Fast, CornersOfARectangleAreFoundAndItsEdgesAreNot) {
    Picture p(160, 120, 60);
    p.rectangle(40, 30, 110, 90, 200);
    ASSERT_EQ(detector_->detect(p.view(), 20, 5, *grid_), Status::kOk);
    const std::vector<Corner> corners = all(*grid_);
    ASSERT_GE(corners.size(), 4U);
    for (const Corner& c : corners) {
        const bool near_x = std::abs(c.x - 40) <= 3 || std::abs(c.x - 109) <= 3;
        const bool near_y = std::abs(c.y - 30) <= 3 || std::abs(c.y - 89) <= 3;
        EXPECT_TRUE(near_x && near_y) << c.x << " " << c.y;
    }
}

TEST_F(Fast, FlatImageHasNoCornersAndAnImageBeyondTheCapacityIsRefused) {
    const Picture flat(100, 80, 128);
    EXPECT_EQ(detector_->detect(flat.view(), 10, 3, *grid_), Status::kOk);
    EXPECT_TRUE(all(*grid_).empty());
    EXPECT_EQ(detector_->detect(ImageView{}, 10, 3, *grid_), Status::kInvalidArgument);
    const Picture wide(kMaxImageWidth + 1, 8, 128);
    EXPECT_EQ(detector_->detect(wide.view(), 10, 3, *grid_), Status::kInvalidArgument);
    const Picture narrow(2 * 5 + 15, 80, 128);
    EXPECT_EQ(detector_->detect(narrow.view(), 10, 5, *grid_), Status::kInvalidArgument);
}

TEST_F(Fast, MarginIsKeptAndNeighboursAreSuppressed) {
    Picture p = noise(160, 96, 9);
    ASSERT_EQ(detector_->detect(p.view(), 10, 14, *grid_), Status::kOk);
    const std::vector<Corner> corners = all(*grid_);
    std::set<std::pair<int, int>> places;
    for (const Corner& c : corners) {
        EXPECT_TRUE(c.x >= 14 && c.x < 160 - 14 && c.y >= 14 && c.y < 96 - 14);
        places.insert({c.x, c.y});
    }
    for (const Corner& c : corners) {
        EXPECT_EQ(places.count({c.x + 1, c.y}) + places.count({c.x, c.y + 1}) + places.count({c.x + 1, c.y + 1}), 0U);
    }
}

TEST_F(Fast, FullCellKeepsItsBestCorners) {
    grid_->clear();
    for (int i = 0; i < 20; ++i) {
        grid_->add(
            {static_cast<std::int16_t>(i % 16), static_cast<std::int16_t>(i / 16), static_cast<std::uint8_t>(10 + i)});
    }
    ASSERT_EQ(grid_->count(0), CornerGrid::kPerCell);
    for (int i = 0; i < CornerGrid::kPerCell; ++i) {
        EXPECT_EQ(grid_->corner(0, i).score, 29 - i);
    }
}

class Selection : public Fast {
protected:
    void SetUp() override {
        mask_.resize(picture_.pixels.size(), 0);
        ASSERT_EQ(detector_->detect(picture_.view(), 10, 5, *grid_), Status::kOk);
        selector_->begin(picture_.width, picture_.height);
    }
    [[nodiscard]] OwnerMaskView mask() const { return {mask_.data(), picture_.width, picture_.height}; }

    Picture picture_ = noise(320, 160, 5);
    std::vector<std::uint8_t> mask_;
    FeatureBudget budget_{};
    std::unique_ptr<CornerSelector> selector_ = std::make_unique<CornerSelector>();
    std::unique_ptr<SelectedCorners> chosen_ = std::make_unique<SelectedCorners>();
};

TEST_F(Selection, BudgetIsKeptAndChosenCornersLieApart) {
    budget_[0] = 100;
    selector_->select(*grid_, mask(), budget_, *chosen_);
    EXPECT_EQ(chosen_->size(), 100);
    for (int i = 0; i < chosen_->size(); ++i) {
        for (int k = 0; k < i; ++k) {
            const Corner& a = (*chosen_)[i].corner;
            const Corner& b = (*chosen_)[k].corner;
            EXPECT_GE(std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)), 3);
        }
    }
}

TEST_F(Selection, CornersBelongToTheOwnerThatTheMaskShows) {
    for (int y = 40; y < 120; ++y) {
        for (int x = 100; x < 220; ++x) {
            mask_[static_cast<std::size_t>(y * 320 + x)] = 3;
        }
    }
    budget_[0] = 60;
    budget_[3] = 40;
    selector_->select(*grid_, mask(), budget_, *chosen_);
    int object = 0;
    for (const SelectedCorner& s : *chosen_) {
        const bool inside = s.corner.x >= 100 && s.corner.x < 220 && s.corner.y >= 40 && s.corner.y < 120;
        EXPECT_EQ(s.owner, inside ? 3 : 0);
        object += s.owner == 3 ? 1 : 0;
    }
    EXPECT_EQ(object, 40);
    EXPECT_EQ(chosen_->size(), 100);
}

TEST_F(Selection, NothingIsChosenBesideALivingFeatureOrWithoutBudget) {
    selector_->select(*grid_, mask(), budget_, *chosen_);
    EXPECT_TRUE(chosen_->empty());
    budget_[0] = 400;
    selector_->begin(320, 160);
    selector_->occupy(0, 160.0F, 80.0F);
    selector_->select(*grid_, mask(), budget_, *chosen_);
    ASSERT_GT(chosen_->size(), 50);
    for (const SelectedCorner& s : *chosen_) {
        EXPECT_FALSE(std::abs(s.corner.x - 160) < 4 && std::abs(s.corner.y - 80) < 4);
    }
}

TEST_F(Selection, CornersAreSpreadOverTheImage) {
    budget_[0] = 40;
    selector_->select(*grid_, mask(), budget_, *chosen_);
    std::set<int> cells;
    for (const SelectedCorner& s : *chosen_) {
        cells.insert(s.corner.y / 32 * 10 + s.corner.x / 32);
    }
    EXPECT_GE(cells.size(), 35U);
}

}  // namespace
}  // namespace semtrack
