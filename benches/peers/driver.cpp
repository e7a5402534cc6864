// Times evaluators side by side: every row once, fresh random joints from memory, processor time of this thread, the least
// of many rounds in which all candidates take turns. What disagrees with trueaxis' scalar C is not timed.
#include <cmath>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <ctime>
#include <vector>

extern "C" {
#include "lidar.h"
}

using Peer = void (*)(const double *errors, const double *joints, double *out);

// Written by compare.py: the peers' wrappers, and which derivatives of the Jacobian they put out.
#include "peers.inc"

// Generated Rust behind C names, in ours.rs.
extern "C" void rust_prepare(const mobile_lidar_errors *errors);
extern "C" void rust_first_order_error(size_t rows, const double *const *joints, double *const *out);
extern "C" void rust_exact_error(size_t rows, const double *const *joints, double *const *out);
extern "C" void rust_first_order_jacobian(size_t rows, const double *const *joints);

static const size_t ROWS = 1000000 / 64 * 64;
static const char *const FORMS[] = {"first_order_error", "exact_error", "first_order_jacobian"};

static mobile_lidar_first_order_error_prepared first_order;
static mobile_lidar_exact_error_prepared exact;
static mobile_lidar_first_order_jacobian_prepared jacobian;
static mobile_lidar_first_order_jacobian_block block;
static double errors[30];
static std::vector<double> joints[3], out[6];

static double processor_ns()
{
    timespec time;
    clock_gettime(CLOCK_THREAD_CPUTIME_ID, &time);
    return time.tv_sec * 1e9 + time.tv_nsec;
}

// SplitMix64. Source: Steele, Lea, Flood, OOPSLA 2014.
static double random_unit()
{
    static uint64_t state = 1;
    uint64_t z = (state += 0x9e3779b97f4a7c15);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9;
    z = (z ^ (z >> 27)) * 0x94d049bb133111eb;
    return double((z ^ (z >> 31)) >> 11) / double(uint64_t(1) << 52) - 1.0;
}

// What our scalar C says of a row, in the order of the peers' outputs.
static std::vector<double> expected(int form, size_t row)
{
    const mobile_lidar_joints pose = {joints[0][row], joints[1][row], joints[2][row]};
    if (form == 2) {
        mobile_lidar_jacobian all;
        mobile_lidar_first_order_jacobian(&jacobian, &pose, &all);
        std::vector<double> values;
        for (const auto &place : DERIVATIVES)
            values.push_back(place[0] < 3 ? all.pointing[place[0]][place[1]] : all.position[place[0] - 3][place[1]]);
        return values;
    }
    mobile_lidar_observed observed;
    if (form == 0)
        mobile_lidar_first_order_error(&first_order, &pose, &observed);
    else
        mobile_lidar_exact_error(&exact, &pose, &observed);
    std::vector<double> values(observed.pointing, observed.pointing + 3);
    values.insert(values.end(), observed.position, observed.position + 3);
    return values;
}

// The largest difference over a thousand rows.
static double difference(int form, Peer peer)
{
    double largest = 0.0;
    for (size_t row = 0; row < 1000; row++) {
        const double pose[3] = {joints[0][row], joints[1][row], joints[2][row]};
        const std::vector<double> values = expected(form, row);
        std::vector<double> found(values.size(), NAN);
        peer(errors, pose, found.data());
        for (size_t i = 0; i < values.size(); i++) {
            const double off = std::fabs(found[i] - values[i]);
            if (!(off <= largest))
                largest = off;
        }
    }
    return largest;
}

static double time_peer(int form, Peer peer)
{
    static double rows[64][sizeof DERIVATIVES / sizeof *DERIVATIVES];
    const double start = processor_ns();
    for (size_t row = 0; row < ROWS; row++) {
        const double pose[3] = {joints[0][row], joints[1][row], joints[2][row]};
        if (form == 2) {
            peer(errors, pose, rows[row % 64]);
            continue;
        }
        double values[6];
        peer(errors, pose, values);
        for (int i = 0; i < 6; i++)
            out[i][row] = values[i];
    }
    return (processor_ns() - start) / ROWS;
}

static double time_ours(int form, bool rust)
{
    const double *const columns[3] = {joints[0].data(), joints[1].data(), joints[2].data()};
    double *const results[6] = {out[0].data(), out[1].data(), out[2].data(),
                                out[3].data(), out[4].data(), out[5].data()};
    mobile_lidar_joint_rows in = {columns[0], columns[1], columns[2]};
    const mobile_lidar_observed_rows observed = {{results[0], results[1], results[2]},
                                                 {results[3], results[4], results[5]}};
    const double start = processor_ns();
    if (form == 0 && rust)
        rust_first_order_error(ROWS, columns, results);
    else if (form == 0)
        mobile_lidar_first_order_error_rows(&first_order, ROWS, &in, &observed);
    else if (form == 1 && rust)
        rust_exact_error(ROWS, columns, results);
    else if (form == 1)
        mobile_lidar_exact_error_rows(&exact, ROWS, &in, &observed);
    else if (rust)
        rust_first_order_jacobian(ROWS, columns);
    else
        for (size_t row = 0; row < ROWS; row += 64) {
            in = {columns[0] + row, columns[1] + row, columns[2] + row};
            mobile_lidar_first_order_jacobian_rows_of_block(&jacobian, 64, &in, &block);
        }
    return (processor_ns() - start) / ROWS;
}

// Prints a line for each candidate: who, form, largest difference, nanoseconds a row.
int main(int count, char **arguments)
{
    const int rounds = count > 1 ? std::atoi(arguments[1]) : 15;
    mobile_lidar_errors named;
    for (int i = 0; i < 30; i++)
        errors[i] = ((double *)&named)[i] = 5e-4 * random_unit();
    for (auto &column : joints)
        for (size_t row = 0; row < ROWS; row++)
            column.push_back(3.141592653589793 * random_unit());
    for (auto &column : out)
        column.resize(ROWS);
    mobile_lidar_first_order_error_prepare(&named, &first_order);
    mobile_lidar_exact_error_prepare(&named, &exact);
    mobile_lidar_first_order_jacobian_prepare(&named, &jacobian);
    rust_prepare(&named);

    const size_t peers = sizeof PEERS / sizeof *PEERS;
    std::vector<double> off(peers), least(peers, INFINITY), ours(6, INFINITY);
    for (size_t i = 0; i < peers; i++)
        off[i] = difference(PEERS[i].form, PEERS[i].peer);
    for (int round = 0; round < rounds; round++) {
        for (size_t i = 0; i < peers; i++)
            if (off[i] < 1e-14)
                least[i] = std::fmin(least[i], time_peer(PEERS[i].form, PEERS[i].peer));
        for (int i = 0; i < 6; i++)
            ours[i] = std::fmin(ours[i], time_ours(i / 2, i % 2));
    }
    for (size_t i = 0; i < peers; i++)
        std::printf("%s,%s,%.3g,%.4f\n", PEERS[i].name, FORMS[PEERS[i].form], off[i], least[i]);
    for (int i = 0; i < 6; i++)
        std::printf("trueaxis %s,%s,0,%.4f\n", i % 2 ? "Rust" : "C", FORMS[i / 2], ours[i]);
}
