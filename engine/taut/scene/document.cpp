#include "taut/scene/private/document.h"

#include "taut/core/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>
#include <vector>

namespace {

// Thrown where toml++ would end the program: a few malformed texts trigger its assertions.
struct Stumble {};
[[noreturn]] void stumble() {
    throw Stumble();
}

}  // namespace

#undef NDEBUG  // with it toml++ would assume its assertions hold
#define TOML_ASSERT(condition) ((condition) ? void() : stumble())
#include <toml++/toml.h>

namespace taut::scene {

namespace {

constexpr int maxDots = 16;  // in one key; toml++ itself limits the nesting of values

Place placeOf(const toml::source_position& position, int origin) {
    return {origin, static_cast<int>(position.line), static_cast<int>(position.column)};
}

bool isBefore(const Member& a, const Member& b) {
    return std::pair(a.place.line, a.place.column) < std::pair(b.place.line, b.place.column);
}

Node nodeOf(const toml::node& source, int origin) {
    Node node;
    node.place = placeOf(source.source().begin, origin);
    node.end = placeOf(source.source().end, origin);
    if (const toml::table* table = source.as_table()) {
        node.kind = NodeKind::table;
        for (const auto& [key, value] : *table) {
            node.members.push_back(
                {std::string(key.str()), placeOf(key.source().begin, origin), nodeOf(value, origin)});
        }
        std::stable_sort(node.members.begin(), node.members.end(), isBefore);
    } else if (const toml::array* list = source.as_array()) {
        node.kind = NodeKind::list;
        for (const toml::node& item : *list) node.items.push_back(nodeOf(item, origin));
    } else if (const auto* text = source.as_string()) {
        node.kind = NodeKind::text;
        node.text = text->get();
    } else if (const auto* whole = source.as_integer()) {
        node.kind = NodeKind::whole;
        node.whole = whole->get();
        node.number = static_cast<double>(whole->get());
    } else if (const auto* number = source.as_floating_point()) {
        node.kind = NodeKind::number;
        node.number = number->get();
    } else if (const auto* flag = source.as_boolean()) {
        node.kind = NodeKind::flag;
        node.flag = flag->get();
    } else {
        node.kind = NodeKind::time;
    }
    return node;
}

// A table in braces that continues on the next line, which TOML does not allow.
struct BrokenTable {
    Place place;  // of the brace
    int lastLine = 0;
    std::string remedy;
};

// Walks over a text just far enough to tell strings and comments from the rest.
class Scanner {
  public:
    Scanner(std::string_view text, int origin) : text_(text), origin_(origin) {}

    // Throws for text that the parser would wrongly accept or crash on.
    void check() {
        if (text_.starts_with("\xFF\xFE") || text_.starts_with("\xFE\xFF")) fail("this is UTF-16; a scene is UTF-8");
        const std::size_t zero = text_.find('\0');
        if (zero != std::string_view::npos) {
            at_ = zero;
            fail("this is not a text file: it holds a zero byte");
        }
        int dots = 0;
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (c == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (c == '"' || c == '\'') {
                skipString(c);
            } else {
                // toml++ 3.3 has undefined behaviour for some letters here; TOML 1.0 allows none of them.
                if (static_cast<unsigned char>(c) >= 0x80) fail("a letter beyond ASCII stands outside of quotes");
                if (c == '.' && ++dots > maxDots) fail("this key has too many parts");
                if (std::string_view(",[]{}=\n").find(c) != std::string_view::npos) dots = 0;
                follow(c);
                ++at_;
            }
        }
    }

    // The first table in braces that does not end on its line.
    const std::optional<BrokenTable>& brokenTable() const { return broken_; }

  private:
    // Keeps track of the header and key to which a brace belongs.
    void follow(char c) {
        const std::string_view line = text_.substr(lineStart_, at_ - lineStart_);
        if (c == '[' || c == '{') {
            if (open_.empty()) isHeader_ = c == '[' && line.find_first_not_of(" \t") == std::string_view::npos;
            if (open_.empty()) opening_ = c;
            open_.push_back({c, at_});
        } else if ((c == ']' || c == '}') && !open_.empty()) {
            open_.pop_back();
            if (open_.empty() && isHeader_) header_ = trimmed(line, "[] \t");
        } else if (c == '=' && open_.empty()) {
            key_ = trimmed(line, " \t");
        } else if (c == '\n') {
            if (!broken_ && !open_.empty() && open_.back().bracket == '{') enterBroken();
            lineStart_ = at_ + 1;
            if (isHeader_) open_.clear();  // a header ends with its line even if not closed
        }
    }

    void enterBroken() {
        const std::string title = header_.empty() ? key_ : header_ + "." + key_;
        const bool isInList = opening_ == '[';
        broken_ = BrokenTable{
            placeAt(open_.back().at), placeAt(at_).line,
            fmt::format("write it on one line, or as {}{}{}", isInList ? "[[" : "[", title, isInList ? "]]" : "]")};
    }

    static std::string trimmed(std::string_view text, const char* blanks) {
        const std::size_t first = text.find_first_not_of(blanks);
        if (first == std::string_view::npos) return {};
        return std::string(text.substr(first, text.find_last_not_of(blanks) - first + 1));
    }

    void skipString(char quote) {
        const std::string fence(3, quote);
        const bool isLong = text_.substr(at_, 3) == fence;
        at_ += isLong ? 3 : 1;
        while (at_ < text_.size()) {
            const char c = text_[at_];
            if (isLong ? text_.substr(at_, 3) == fence : (c == quote || c == '\n')) break;
            const bool isEscape = c == '\\' && quote == '"';
            if (isEscape && isLong) checkEscape();
            at_ += isEscape ? 2 : 1;
        }
        at_ = std::min(at_ + (isLong ? 3 : 1), text_.size());
        // A long string may end in one or two quotes of its own.
        for (int i = 0; i < 2 && isLong && at_ < text_.size() && text_[at_] == quote; ++i) ++at_;
    }

    // Outside of strings, and after a backslash that breaks a line, toml++ fails on letters beyond ASCII.
    void checkEscape() {
        const std::size_t next = text_.find_first_not_of(" \t\r\n", at_ + 1);
        if (next == std::string_view::npos || static_cast<unsigned char>(text_[next]) < 0x80) return;
        at_ = next;
        fail("a letter beyond ASCII follows a backslash");
    }

    Place placeAt(std::size_t byte) const {
        const std::string_view before = text_.substr(0, byte);
        const auto line = 1 + std::count(before.begin(), before.end(), '\n');
        const std::size_t start = before.rfind('\n') + 1;  // 0 when there is none
        return {origin_, static_cast<int>(line), static_cast<int>(byte - start) + 1};
    }
    [[noreturn]] void fail(const std::string& message) const { throw SyntaxError(placeAt(at_), message); }

    struct Bracket {
        char bracket;
        std::size_t at;
    };

    std::string_view text_;
    int origin_;
    std::size_t at_ = 0, lineStart_ = 0;
    std::vector<Bracket> open_;
    char opening_ = 0;  // the outermost
    bool isHeader_ = false;
    std::string header_, key_;
    std::optional<BrokenTable> broken_;
};

// The line at which toml++ fails: the shortest beginning of the text that makes it fail ends there.
int stumbleLine(std::string_view text) {
    std::vector<std::size_t> ends;
    for (std::size_t i = 0; i < text.size(); ++i)
        if (text[i] == '\n') ends.push_back(i + 1);
    ends.push_back(text.size());
    const auto doesStumble = [&](std::size_t end) {
        try {
            (void)toml::parse(text.substr(0, end));
        } catch (const Stumble&) {
            return true;
        } catch (const toml::parse_error&) {
        }
        return false;
    };
    const auto found =
        std::partition_point(ends.begin(), ends.end(), [&](std::size_t end) { return !doesStumble(end); });
    return static_cast<int>(std::min(found - ends.begin(), std::ssize(ends) - 1)) + 1;
}

}  // namespace

Node documentTree(std::string_view text, int origin) {
    Scanner scanner(text, origin);
    scanner.check();
    try {
        return nodeOf(toml::parse(text), origin);
    } catch (const toml::parse_error& error) {
        const std::optional<BrokenTable>& table = scanner.brokenTable();
        if (table && static_cast<int>(error.source().begin.line) >= table->lastLine)
            throw SyntaxError(table->place, "a table in braces must end on the line where it begins", table->remedy);
        std::string_view message = error.description();
        constexpr std::string_view opening = "Error while parsing ";
        if (message.starts_with(opening)) message.remove_prefix(opening.size());
        throw SyntaxError(placeOf(error.source().begin, origin), std::string(message));
    } catch (const Stumble&) {
        throw SyntaxError({origin, stumbleLine(text), 1}, "this line is not TOML");
    }
}

Node treeOf(std::string_view text, int origin, fields::Problems& problems) {
    try {
        return documentTree(text, origin);
    } catch (const SyntaxError& error) {
        problems.addError(error.place, error.what(), error.remedy);
        throw core::Error(core::ErrorKind::badContent, problems.errors());
    }
}

}  // namespace taut::scene
