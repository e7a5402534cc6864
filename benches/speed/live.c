/* Times one pose, and many, of the generated C: see src/bin/live_speed.rs. */
#include <stdio.h>
#include <stdlib.h>
#include <time.h>

#include "lidar.h"

enum { poses = 4096, passes = 50 };
static double alpha[poses], beta[poses], gamma_[poses], columns[12][poses];

static double now_ns(void)
{
    struct timespec time;
    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &time);
    return 1e9 * (double)time.tv_sec + (double)time.tv_nsec;
}

int main(void)
{
    mobile_lidar_exact_error_prepared correction;
    mobile_lidar_uncertainty_prepared sure;
    const mobile_lidar_joint_rows joint_rows = {alpha, beta, gamma_};
    mobile_lidar_observed_rows out_rows;
    volatile double sink = 0.0;
    double start;
    int pass, row;
    for (row = 0; row < poses; row++) {
        alpha[row] = 6.0 * rand() / RAND_MAX;
        beta[row] = 6.0 * rand() / RAND_MAX;
        gamma_[row] = 6.0 * rand() / RAND_MAX;
    }
    for (row = 0; row < (int)(sizeof out_rows / sizeof(double *)); row++)
        ((double **)&out_rows)[row] = columns[row];
    mobile_lidar_exact_error_prepare(&correction);
    mobile_lidar_uncertainty_prepare(&sure);

    start = now_ns();
    for (pass = 0; pass < passes; pass++)
        for (row = 0; row < poses; row++) {
            const mobile_lidar_joints joints = {alpha[row], beta[row], gamma_[row]};
            mobile_lidar_observed by;
            mobile_lidar_exact_error(&correction, &joints, &by);
            sink = by.pointing[0];
        }
    printf("1 correction: %.3f\n", (now_ns() - start) / ((double)passes * poses));

    start = now_ns();
    for (pass = 0; pass < passes; pass++)
        for (row = 0; row < poses; row++) {
            const mobile_lidar_joints joints = {alpha[row], beta[row], gamma_[row]};
            mobile_lidar_observed by, standard;
            mobile_lidar_exact_error(&correction, &joints, &by);
            mobile_lidar_uncertainty(&sure, &joints, &standard);
            sink = by.pointing[0] + standard.pointing[2];
        }
    printf("2 correction and uncertainty: %.3f\n", (now_ns() - start) / ((double)passes * poses));

    start = now_ns();
    for (pass = 0; pass < 20 * passes; pass++)
        mobile_lidar_exact_error_rows(&correction, poses, &joint_rows, &out_rows);
    printf("3 correction, many poses: %.3f\n", (now_ns() - start) / (20.0 * passes * poses));
    (void)sink;
    return 0;
}
