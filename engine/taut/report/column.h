// A record spelled once: the names of its fields, and how each is read. CSV, JSON and tables for people are made of it.
// It knows nothing of the records.
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "taut/report/table.h"

namespace taut::report {

// The texts that have a column.
enum class In { files, csv, json, people };

// `read` is a member of the row, or a function of it: a number, a truth, a text, or several texts. A column of the
// files may have a heading for people too, who may read it in another way.
template <class Row>
struct Column {
    using Read = std::function<Cell(const Row&)>;
    template <class R>
    Column(std::string title, R read, In texts = In::files) : name(std::move(title)), in(texts), cell(reader(read)) {
        if (in == In::people) heading = name, brief = cell;
    }
    template <class R, class ForPeople>
    Column(std::string title, R read, std::string words, ForPeople forPeople)
        : name(std::move(title)), heading(std::move(words)), cell(reader(read)), brief(reader(forPeople)) {}
    template <class R>
    Column(std::string title, R read, std::string words) : Column(std::move(title), read, std::move(words), read) {}

    template <class R>
    static Read reader(R read) {
        return [read](const Row& row) -> Cell {
            const auto& value = std::invoke(read, row);
            using Value = std::decay_t<decltype(value)>;
            if constexpr (std::is_integral_v<Value> && !std::is_same_v<Value, bool>)
                return static_cast<long long>(value);
            else if constexpr (std::is_convertible_v<Value, std::string_view>)
                return std::string(std::string_view(value));
            else
                return value;
        };
    }

    std::string name;
    std::optional<std::string> heading{};  // none: not for people
    In in = In::files;
    Read cell, brief{};
};

template <class Row>
using Columns = std::vector<Column<Row>>;

// Of one of the texts: `csv`, `json` or `people`.
template <class Row, class Rows>
TextTable tableOf(const Columns<Row>& columns, const Rows& rows, In text) {
    const bool isForPeople = text == In::people;
    TextTable table;
    table.rows.resize(rows.size());
    for (const Column<Row>& column : columns) {
        if (isForPeople ? !column.heading : column.in != In::files && column.in != text) continue;
        table.columns.push_back(isForPeople ? *column.heading : column.name);
        for (std::size_t i = 0; i < rows.size(); ++i)
            table.rows[i].push_back((isForPeople ? column.brief : column.cell)(rows[i]));
    }
    return table;
}

// A list of objects, of any library for JSON.
template <class Json, class Row, class Rows>
Json jsonOf(const Columns<Row>& columns, const Rows& rows) {
    const TextTable table = tableOf(columns, rows, In::json);
    Json list = Json::array();
    for (const auto& cells : table.rows) {
        Json& object = list.emplace_back();
        for (std::size_t i = 0; i < cells.size(); ++i)
            std::visit([&](const auto& value) { object[table.columns[i]] = value; }, cells[i]);
    }
    return list;
}

}  // namespace taut::report
