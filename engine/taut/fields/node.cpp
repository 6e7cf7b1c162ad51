#include "taut/fields/node.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace taut::fields {

const Member* Node::find(std::string_view key) const {
    const auto found = std::find_if(members.begin(), members.end(), [&](const Member& m) { return m.key == key; });
    return found == members.end() ? nullptr : &*found;
}

Member* Node::find(std::string_view key) {
    return const_cast<Member*>(std::as_const(*this).find(key));
}

std::string description(const Node& node) {
    constexpr std::size_t maxLength = 40;
    switch (node.kind) {
        case NodeKind::flag: return node.flag ? "true" : "false";
        case NodeKind::whole: return fmt::format("{}", node.whole);
        case NodeKind::number: return fmt::format("{}", node.number);
        case NodeKind::text:
            if (node.text.size() > maxLength) return "a long text";
            return fmt::format("\"{}\"", node.text);
        case NodeKind::time: return "a date or time";
        case NodeKind::list: return fmt::format("a list of {}", node.items.size());
        case NodeKind::table: return "a table";
    }
    return "";
}

}  // namespace taut::fields
