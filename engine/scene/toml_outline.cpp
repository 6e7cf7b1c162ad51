#include "taut/scene/toml_outline.h"

#include <algorithm>
#include <map>

namespace taut::scene {

namespace {

class Outliner {
  public:
    explicit Outliner(std::string_view text) : text_(text) {}

    Outline outline() {
        out_.headers.push_back({});
        if (text_.starts_with("\xEF\xBB\xBF")) at_ = 3;
        while (skipToContent(), at_ < text_.size()) {
            if (text_[at_] == '[') {
                readHeader();
            } else {
                readPair(out_.headers.back().path, true);
            }
        }
        return std::move(out_);
    }

  private:
    char now() const { return at_ < text_.size() ? text_[at_] : '\0'; }

    void skipBlanks() {
        while (now() == ' ' || now() == '\t') ++at_;
    }

    // Over blanks, line ends and comments.
    void skipToContent() {
        while (at_ < text_.size()) {
            if (text_[at_] == '#') {
                at_ = std::min(text_.find('\n', at_), text_.size());
            } else if (std::string_view(" \t\r\n").find(text_[at_]) != std::string_view::npos) {
                ++at_;
            } else {
                return;
            }
        }
    }

    void skipString() {
        const char quote = text_[at_];
        const std::string fence(3, quote);
        const bool isLong = text_.substr(at_, 3) == fence;
        at_ += isLong ? 3 : 1;
        while (at_ < text_.size() && !(isLong ? text_.substr(at_, 3) == fence : text_[at_] == quote))
            at_ += text_[at_] == '\\' && quote == '"' ? 2 : 1;
        at_ = std::min(at_ + (isLong ? 3 : 1), text_.size());
        for (int i = 0; i < 2 && isLong && now() == quote; ++i) ++at_;  // a long string may end in quotes of its own
    }

    // One or more keys with dots between them; quoted ones without their quotes.
    KeyPath readKeys() {
        KeyPath keys;
        while (at_ < text_.size()) {
            skipBlanks();
            const std::size_t begin = at_;
            if (now() == '"' || now() == '\'') {
                skipString();
                keys.emplace_back(text_.substr(begin + 1, at_ - begin - 2));
            } else {
                while (at_ < text_.size() && std::string_view(" \t\r\n.=]").find(text_[at_]) == std::string_view::npos)
                    ++at_;
                keys.emplace_back(text_.substr(begin, at_ - begin));
            }
            skipBlanks();
            if (now() != '.') break;
            ++at_;
        }
        return keys;
    }

    // A key of a list of tables means its last element so far.
    KeyPath resolved(const KeyPath& keys) const {
        KeyPath path;
        for (const std::string& key : keys) {
            path.push_back(key);
            const auto found = elements_.find(path);
            if (found != elements_.end()) path.push_back(std::to_string(found->second - 1));
        }
        return path;
    }

    void readHeader() {
        const bool isList = text_.substr(at_, 2) == "[[";
        at_ += isList ? 2 : 1;
        KeyPath keys = readKeys();
        at_ = std::min(at_ + (isList ? 2 : 1), text_.size());
        if (isList) {
            const std::string last = keys.back();
            keys.pop_back();
            KeyPath list = resolved(keys);
            list.push_back(last);
            ++elements_[list];
            keys.push_back(last);
        }
        out_.headers.push_back({resolved(keys), at_});
    }

    void readPair(const KeyPath& table, bool isStatement) {
        OutlineValue value;
        value.keyBegin = at_;
        value.isStatement = isStatement;
        value.path = table;
        for (std::string& key : readKeys()) value.path.push_back(std::move(key));
        at_ = std::min(at_ + 1, text_.size());  // the =
        skipBlanks();
        readValue(std::move(value));
    }

    void readValue(OutlineValue value) {
        const KeyPath path = value.path;
        const std::size_t number = out_.values.size();
        value.begin = at_;
        value.section = out_.headers.size() - 1;
        out_.values.push_back(std::move(value));
        if (now() == '{') {
            readItems('}', [&](int) { readPair(path, false); });
        } else if (now() == '[') {
            readItems(']', [&](int i) {
                OutlineValue item;
                item.keyBegin = at_;
                item.path = path;
                item.path.push_back(std::to_string(i));
                readValue(std::move(item));
            });
        } else if (now() == '"' || now() == '\'') {
            skipString();
        } else {
            at_ = std::min(text_.find_first_of(",]}#\r\n", at_), text_.size());
            while (at_ > 0 && (text_[at_ - 1] == ' ' || text_[at_ - 1] == '\t')) --at_;
        }
        out_.values[number].end = at_;
    }

    template <class Read>
    void readItems(char closing, const Read& read) {
        ++at_;
        int count = 0;
        while (skipToContent(), at_ < text_.size() && now() != closing) {
            const std::size_t before = at_;
            read(count++);
            skipToContent();
            if (now() == ',') ++at_;
            if (at_ == before) return;  // not TOML: do not stand still
        }
        at_ = std::min(at_ + 1, text_.size());
    }

    std::string_view text_;
    std::size_t at_ = 0;
    Outline out_;
    std::map<KeyPath, int> elements_;  // of each list of tables, so far
};

}  // namespace

Outline outlineOf(std::string_view text) {
    return Outliner(text).outline();
}

}  // namespace taut::scene
