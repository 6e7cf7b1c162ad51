// The points and the places on colliders at which ties of a constraint end, and their numbers as Constraint::Moment
// has them.
#pragma once

#include <algorithm>
#include <vector>

#include "taut/body/spot.h"
#include "taut/plan/constraint.h"

namespace taut::world {

class TieEnds {
  public:
    // The spot of the plan, in numbers of Moment. Ties that are there already have spots a and b; if they end at places
    // that are now counted after more points, they get new numbers.
    template <class Ties>
    Spot of(const Spot& spot, Ties& ties) {
        return spot.renumbered([&](int point) {
            const auto found = std::find(points.begin(), points.end(), point);
            if (found != points.end()) return static_cast<int>(found - points.begin());
            const int number = static_cast<int>(points.size());
            points.push_back(point);
            if (!places.empty())
                for (auto& tie : ties)
                    for (Spot* end : {&tie.a, &tie.b})
                        *end = end->renumbered([&](int old) { return old + (old >= number ? 1 : 0); });
            return number;
        });
    }
    // Expects no places yet.
    Spot of(const Spot& spot) {
        struct Ends {
            Spot a, b;
        };
        std::vector<Ends> none;
        return of(spot, none);
    }
    Spot of(const Constraint::Place& place) {
        places.push_back(place);
        return static_cast<int>(points.size() + places.size()) - 1;
    }
    // The difference of two spots, a - b: each point once.
    static std::vector<Spot::Share> difference(const Spot& a, const Spot& b) {
        std::vector<Spot::Share> all(a.shares().begin(), a.shares().end());
        for (const Spot::Share& other : b.shares()) {
            const auto same =
                std::find_if(all.begin(), all.end(), [&](const auto& own) { return own.point == other.point; });
            if (same != all.end())
                same->weight -= other.weight;
            else
                all.push_back({other.point, -other.weight});
        }
        return all;
    }
    bool isPlace(int number) const { return number >= static_cast<int>(points.size()); }

    std::vector<int> points;  // of the plan
    std::vector<Constraint::Place> places;
};

}  // namespace taut::world
