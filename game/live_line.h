// One line of progress on standard error. On a terminal it is rewritten in place, otherwise a plain line appears now
// and then. Independent of its source.
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

    // Whether it is time for another line; always for the last one. If so, show() must follow.
    bool isDue(bool last);
    void show(const std::string& text);

  private:
    bool quiet_;
    bool live_;
    bool open_ = false;
    std::chrono::steady_clock::time_point shown_ = std::chrono::steady_clock::now();
};

}  // namespace taut::game
