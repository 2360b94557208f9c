// Calling CalculiX (ccx), a finite element program, and reading what it prints.
#pragma once

#include "launchsafe/store/program.hpp"
#include "launchsafe/verify/finite_element_deck.hpp"

#include <string>
#include <string_view>
#include <vector>

namespace launchsafe::verify {

/// Pressure (compression positive) and von Mises stress, Pa.
struct StressMeasures {
  double pressure = 0, von_mises = 0;
};

/// Cauchy stress at an integration point, Pa, tension positive.
struct CauchyStress {
  double rr = 0, xx = 0, tt = 0, rx = 0;
  StressMeasures measures() const;
};

/// What a finite element computation printed.
struct FiniteElementResult {
  std::vector<CauchyStress> stress;  ///< of every element, its integration points one after the other
  const CauchyStress& at(int element, int point) const {
    return stress[static_cast<std::size_t>(element * integration_points + point)];
  }
};

/// Reads the stresses of so many elements at the last increment out of the text that ccx
/// leaves in its .dat file. Errors: corrupt.
store::Result<FiniteElementResult> read_finite_element_output(std::string_view text, int elements);

/// What ccx says its version is: "2.20". Errors: missing (it is not installed), failed.
store::Result<std::string> finite_element_version();

/// Runs ccx on the model's deck in a temporary folder of its own. Errors: missing, failed (what ccx said
/// last), corrupt, write_failed.
store::Result<FiniteElementResult> run_finite_elements(const FiniteElementModel& model,
                                                       const store::ProgramLimits& limits = {.time = 600.0});

}  // namespace launchsafe::verify
