#include "taut/report/table.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <limits>
#include <nlohmann/json.hpp>

#include "taut/report/column.h"

namespace taut::report {
namespace {

TEST(ReportTable, CsvQuotesWhatWouldBreakARow) {
    const TextTable table{{"name", "what, else"}, {{std::string("say \"no\""), 1LL}, {std::string("two\nlines"), 2LL}}};
    EXPECT_EQ(csv(table), "name,\"what, else\"\n\"say \"\"no\"\"\",1\n\"two\nlines\",2\n");
}

TEST(ReportTable, NumbersOfCsvReadBackAsTheyWere) {
    for (const double value : {0.1, 1.0 / 3.0, 6.02214076e23, 5e-324, -std::numeric_limits<double>::max()}) {
        const std::string text = csv({{"x"}, {{value}}});
        EXPECT_EQ(std::strtod(text.c_str() + 2, nullptr), value) << text;
    }
}

TEST(ReportTable, CellsWithoutANumberAreEmpty) {
    EXPECT_EQ(csv({{"x", "y"}, {{std::nan(""), 2.5}}}), "x,y\n,2.5\n");
    EXPECT_EQ(aligned({{"x", "y"}, {{std::nan(""), 2.5}}}), "x    y\n   2.5\n");
}

TEST(ReportTable, ColumnsAlignByLettersNotBytes) {
    EXPECT_EQ(aligned({{"ω", "n"}, {{std::string("größer"), 7LL}, {std::string("x"), 12LL}}}),
              "ω        n\ngrößer   7\nx       12\n");
}

TEST(ReportTable, ALineEndInATextIsShownAndNotMade) {
    EXPECT_EQ(aligned({{"name", "n"}, {{std::string("two\nlines"), 1LL}}}), "name           n\ntwo\\u{A}lines  1\n");
}

struct Lap {
    std::string name;
    int steps = 0;
    double error = 0;
    bool isGood = false;
};

TEST(ReportColumn, OfOneRecordMakesEveryText) {
    const Columns<Lap> columns = {
        {"name", &Lap::name, "run"},
        {"steps", &Lap::steps},
        {"error_m", &Lap::error, "error", [](const Lap& r) { return r.isGood ? "ok" : "bad"; }},
        {"good", &Lap::isGood, In::json}};
    const std::vector<Lap> runs = {{"a", 3, 0.5, true}, {"b", 4, std::nan(""), false}};
    EXPECT_EQ(csv(tableOf(columns, runs, In::csv)), "name,steps,error_m\na,3,0.5\nb,4,\n");
    EXPECT_EQ(aligned(tableOf(columns, runs, In::people)), "run  error\na    ok\nb    bad\n");
    EXPECT_EQ(
        jsonOf<nlohmann::ordered_json>(columns, runs).dump(),
        R"([{"name":"a","steps":3,"error_m":0.5,"good":true},{"name":"b","steps":4,"error_m":null,"good":false}])");
}

}  // namespace
}  // namespace taut::report
