// Times one pose, and many, of the generated C++: see src/bin/live_speed.rs.
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

#include "lidar.hpp"

namespace lidar = trueaxis::mobile_lidar;

static double now_ns() {
    timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * static_cast<double>(time.tv_sec) + static_cast<double>(time.tv_nsec);
}

int main() {
    constexpr int poses = 4096, passes = 50;
    std::vector<double> alpha(poses), beta(poses), gamma(poses);
    for (int row = 0; row < poses; row++) {
        alpha[row] = 6.0 * std::rand() / RAND_MAX;
        beta[row] = 6.0 * std::rand() / RAND_MAX;
        gamma[row] = 6.0 * std::rand() / RAND_MAX;
    }
    constexpr int outputs = sizeof(lidar::Observed) / sizeof(double);
    std::vector<std::vector<double>> columns(outputs, std::vector<double>(poses));
    lidar::ObservedRows out;
    for (int at = 0; at < outputs; at++)
        reinterpret_cast<trueaxis::Span<double>*>(&out)[at] = columns[at];
    const lidar::ExactError correction;
    const lidar::Uncertainty sure;
    volatile double sink = 0.0;

    double start = now_ns();
    for (int pass = 0; pass < passes; pass++)
        for (int row = 0; row < poses; row++)
            sink = correction({alpha[row], beta[row], gamma[row]}).pointing[0];
    std::printf("1 correction: %.3f\n", (now_ns() - start) / (static_cast<double>(passes) * poses));

    start = now_ns();
    for (int pass = 0; pass < passes; pass++)
        for (int row = 0; row < poses; row++) {
            const lidar::Joints joints{alpha[row], beta[row], gamma[row]};
            sink = correction(joints).pointing[0] + sure(joints).pointing[2];
        }
    std::printf("2 correction and uncertainty: %.3f\n", (now_ns() - start) / (static_cast<double>(passes) * poses));

    bool is_done = true;
    start = now_ns();
    for (int pass = 0; pass < 20 * passes; pass++)
        is_done = correction.rows({alpha, beta, gamma}, out) && is_done;
    std::printf("3 correction, many poses: %.3f\n", (now_ns() - start) / (20.0 * passes * poses));
    (void)sink;
    return is_done ? 0 : 1;
}
