// The laws that there are. A new one is its own file and one line here.
#pragma once

#include "launchsafe/materials/charge.hpp"
#include "launchsafe/materials/linear_elastic.hpp"
#include "launchsafe/materials/steel.hpp"

#include <variant>

namespace launchsafe::materials {

using Law = std::variant<Steel,  //
                         Charge,
                         LinearElastic>;

}  // namespace launchsafe::materials
