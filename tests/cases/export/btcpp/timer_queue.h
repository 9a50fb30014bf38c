// The timers of BehaviorTree.CPP, in place of its own header of this name. The library's timers wait in threads for the
// clock on the wall; these fire when the program says that time passes, so no trace depends on how busy the machine is.

#pragma once

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <map>
#include <set>
#include <utility>
#include <vector>

namespace BT
{
// The time that all timers go by.
class TimerClock
{
public:
  using Time = std::chrono::milliseconds;

  // What has timers.
  class Timed
  {
  public:
    Timed()
    {
      clock().all_.insert(this);
    }

    virtual ~Timed()
    {
      clock().all_.erase(this);
    }

    Timed(const Timed&) = delete;
    Timed& operator=(const Timed&) = delete;

    // Fires the timers whose time has come.
    virtual void fire(Time now) = 0;
  };

  static Time now()
  {
    return clock().now_;
  }

  // Lets time pass.
  static void advance(Time by)
  {
    clock().now_ += by;
    // A handler may make timers or end them.
    const std::vector<Timed*> all(clock().all_.begin(), clock().all_.end());
    for(auto* timed : all)
    {
      if(clock().all_.count(timed) > 0)
      {
        timed->fire(clock().now_);
      }
    }
  }

private:
  static TimerClock& clock()
  {
    static TimerClock clock;
    return clock;
  }

  Time now_{ 0 };
  std::set<Timed*> all_;
};

// Calls each handler once: with false when its time has come, with true if it is cancelled before.
template <typename Clock = std::chrono::steady_clock,
          typename Duration = typename Clock::duration>
class TimerQueue : private TimerClock::Timed
{
public:
  using Handler = std::function<void(bool)>;

  ~TimerQueue() override
  {
    cancelAll();
  }

  uint64_t add(TimerClock::Time after, Handler handler)
  {
    timers_[++last_] = { TimerClock::now() + after, std::move(handler) };
    return last_;
  }

  // How many timers are cancelled: none if it has fired.
  std::size_t cancel(uint64_t id)
  {
    const auto found = timers_.find(id);
    if(found == timers_.end())
    {
      return 0;
    }
    call(found, true);
    return 1;
  }

  std::size_t cancelAll()
  {
    const auto count = timers_.size();
    while(!timers_.empty())
    {
      call(timers_.begin(), true);
    }
    return count;
  }

private:
  using Timers = std::map<uint64_t, std::pair<TimerClock::Time, Handler>>;

  void fire(TimerClock::Time now) override
  {
    for(auto next = timers_.begin(); next != timers_.end();)
    {
      const auto [id, timer] = *next;
      if(timer.first <= now)
      {
        call(next, false);
      }
      next = timers_.upper_bound(id);
    }
  }

  void call(typename Timers::iterator at, bool cancelled)
  {
    const auto handler = std::move(at->second.second);
    timers_.erase(at);
    handler(cancelled);
  }

  Timers timers_;
  uint64_t last_ = 0;
};
}  // namespace BT
