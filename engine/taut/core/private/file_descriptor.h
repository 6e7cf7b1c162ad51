// Owns an open file and closes it. Knows nothing of its contents.
#pragma once

#include <unistd.h>

#include <utility>

namespace taut::core {

class FileDescriptor {
  public:
    explicit FileDescriptor(int number = -1) : number_(number) {}  // -1: none
    FileDescriptor(FileDescriptor&& other) noexcept : number_(std::exchange(other.number_, -1)) {}
    FileDescriptor& operator=(FileDescriptor&& other) noexcept {
        std::swap(number_, other.number_);
        return *this;
    }
    ~FileDescriptor() {
        if (number_ >= 0) ::close(number_);
    }
    int get() const { return number_; }

  private:
    int number_;
};

}  // namespace taut::core
