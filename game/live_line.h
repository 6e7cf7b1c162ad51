// One line on standard error that tells how far something is: rewritten in place on a terminal, a plain line now and
// then otherwise. It does not know what it tells of.
#pragma once

#include <chrono>
#include <string>

namespace taut::game {

class LiveLine {
  public:
    explicit LiveLine(bool quiet);
    ~LiveLine();  // ends the live line
    LiveLine(const LiveLine&) = delete;
    LiveLine& operator=(const LiveLine&) = delete;

    // Whether it is time for another line; the last one always is. Then show() is to follow.
    bool isDue(bool last);
    void show(const std::string& text);

  private:
    bool quiet_;
    bool live_;
    bool open_ = false;
    std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

}  // namespace taut::game
