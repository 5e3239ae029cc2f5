// What g++ makes of OpenMP's directives, over threads of the standard library. For the thread sanitizer only: the runtime of
// g++ (libgomp) is not instrumented, so that the sanitizer does not see where its threads begin, meet and end, and takes every
// loop for a race. Here it sees all of it, and what it then reports is a race in our loops.
//
// Linked before libgomp, these take the place of its functions of the same name. They cover what furrow's directives become:
// `parallel`, `for schedule(static)`, the barrier at its end, and reductions.
#include <mutex>
#include <thread>
#include <vector>

#include <pthread.h>

namespace {

int wanted = 4;
thread_local int own_number = 0, team_size = 1;
thread_local pthread_barrier_t* meeting = nullptr;
std::mutex one_at_a_time;

}  // namespace

extern "C" {

int omp_get_max_threads() { return wanted; }
void omp_set_num_threads(int threads) { wanted = threads; }
int omp_get_num_threads() { return team_size; }
int omp_get_thread_num() { return own_number; }

void GOMP_parallel(void (*body)(void*), void* data, unsigned threads, unsigned) {
  const int team = threads > 0 ? static_cast<int>(threads) : wanted;
  pthread_barrier_t barrier;
  pthread_barrier_init(&barrier, nullptr, static_cast<unsigned>(team));
  const auto take_part = [&](int number) {
    own_number = number;
    team_size = team;
    meeting = &barrier;
    body(data);
    own_number = 0;
    team_size = 1;
    meeting = nullptr;
  };
  std::vector<std::thread> others;
  for (int number = 1; number < team; ++number) others.emplace_back(take_part, number);
  take_part(0);
  for (std::thread& other : others) other.join();
  pthread_barrier_destroy(&barrier);
}

void GOMP_barrier() {
  if (meeting) pthread_barrier_wait(meeting);
}
void GOMP_atomic_start() { one_at_a_time.lock(); }
void GOMP_atomic_end() { one_at_a_time.unlock(); }

}  // extern "C"
