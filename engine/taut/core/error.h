// Errors that the user can correct: an exception with a kind and findings.
#pragma once

#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "taut/core/finding.h"

namespace taut::core {

enum class ErrorKind {
    usage,        // asked for in a way that cannot be meant
    badContent,   // a file says something wrong, or asks for more than the machine has
    diverged,     // the motion left all bounds
    inputOutput,  // a file is missing, unreadable, unwritable; the disk is full; a program did not run
    noRenderer,   // there is nothing to draw with
    interrupted,  // by who waits for it
};

class Error : public std::runtime_error {
  public:
    Error(ErrorKind kind, const std::string& message) : Error(kind, at({}) + message) {}
    Error(ErrorKind kind, Finding finding) : Error(kind, std::vector{std::move(finding)}) {}
    // The message has all findings as printed, one below the other. Expects at least one.
    Error(ErrorKind kind, std::vector<Finding> findings);
    ErrorKind kind() const { return kind_; }
    const std::vector<Finding>& findings() const { return findings_; }

  private:
    ErrorKind kind_;
    std::vector<Finding> findings_;
};

// Ends the program with a message: a programmer's mistake, never a user's.
[[noreturn]] void failCheck(const char* condition, const char* file, int line);

}  // namespace taut::core

// Checks a precondition of the caller; stays on in every build because it is used outside hot loops.
#define TAUT_EXPECTS(condition) ((condition) ? void() : ::taut::core::failCheck(#condition, __FILE__, __LINE__))
