// Sleep to an absolute schedule in C++ and print how late each wake-up was [us], one a line.
// What a loop in a compiled language would see on this machine: no work, the same rank, the same
// CPU. Arguments: period [us], wake-ups, priority, CPU.

#include <sched.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <thread>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 5) {
    std::fputs("usage: sleep_until PERIOD_US COUNT PRIORITY CPU\n", stderr);
    return 2;
  }
  const auto period = std::chrono::microseconds(std::atol(argv[1]));
  const long count = std::atol(argv[2]);
  sched_param rank{};
  rank.sched_priority = std::atoi(argv[3]);
  cpu_set_t cpus;
  CPU_ZERO(&cpus);
  CPU_SET(std::atoi(argv[4]), &cpus);
  sched_setaffinity(0, sizeof cpus, &cpus);
  if (sched_setscheduler(0, SCHED_FIFO, &rank) != 0) std::fputs("no SCHED_FIFO\n", stderr);

  std::vector<double> late_us;
  late_us.reserve(count);
  auto due = std::chrono::steady_clock::now() + period;
  for (long i = 0; i < count; ++i) {
    std::this_thread::sleep_until(due);
    const std::chrono::duration<double, std::micro> late = std::chrono::steady_clock::now() - due;
    late_us.push_back(late.count());
    due += period * (1 + static_cast<long>(late / period));  // missed periods are skipped
  }
  for (const double one : late_us) std::printf("%.1f\n", one);
  return 0;
}
