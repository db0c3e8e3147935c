// usage: consumer SCENE    prints the hash of the scene's CAN frames, and uses Eigen itself at the core's sizes: were the
// archive's Eigen not its own, the linker would put these functions in their place, and the hash would change.
#include <Eigen/Cholesky>
#include <Eigen/Core>
#include <Eigen/LU>

#include <cstdio>
#include <fstream>
#include <iterator>
#include <vector>

#include "board/run_scene.hpp"

namespace {

template <int kRows>
double work(double seed) {
    using Matrix = Eigen::Matrix<double, kRows, kRows>;
    Matrix a = Matrix::Constant(seed);
    for (int i = 0; i < kRows; ++i) {
        a(i, i) += 3.0 + i;
    }
    const Matrix b = a * a.transpose() + 0.1 * Matrix::Identity() - a * a;
    const Matrix c = (-b) * a + (b * a) * a.transpose();
    const Eigen::LLT<Matrix> factor(a * a.transpose() + Matrix::Identity());
    return (factor.solve(c) * a.inverse()).sum() + c.determinant();
}

}  // namespace

int main(int argc, char** argv) {
    if (argc != 2) {
        return 2;
    }
    std::ifstream in(argv[1], std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
    const double own = work<2>(0.1) + work<3>(0.1) + work<4>(0.1) + work<6>(0.1) + work<9>(0.1);
    const auto* const scene = reinterpret_cast<const std::uint8_t*>(bytes.data());
    const semtrack::board::SceneResult result = semtrack::board::run_scene(scene, bytes.size());
    char line[semtrack::board::kLineBytes];
    semtrack::board::format_result(result, line);
    std::fputs(line, stdout);
    return result.complete && own < 1e300 ? 0 : 1;  // its own result is used
}
