// A launch with one cause of uncertainty at an end of its range, as a skin on a trace: what it changes at a
// gap, and where the critical gap then lies.
#pragma once

#include "launchsafe/study/case_uncertainty.hpp"
#include "launchsafe/study/gap_verdict.hpp"
#include "launchsafe/surface/skin.hpp"
#include "launchsafe/trace/bottom_trace.hpp"

#include <memory>
#include <vector>

namespace launchsafe::study {

/// Which end of the range of a cause.
enum class End { towards_ignition, away };

struct RaisedLaunch {
  ShareKind kind = ShareKind::computation;
  surface::SkinModel skin;
  std::shared_ptr<const trace::BottomTrace> trace;  ///< nothing where the end is not known
  double thicker = 0;                               ///< m, by which the gap is thicker
};

/// The random causes of a case, one by one at their ends: the muzzle exit where its scene states a spread;
/// peak pressure, length of the pulse and initial temperature where the study states no uncertainty of the
/// inputs. The lower pressure was not run: its trace is the mirror of the raised one (trace::mirrored).
std::vector<RaisedLaunch> raised_inputs(const Study& study, const CaseOutcome& outcome, End end);

/// All causes. `row`: the case at a gap next to its critical one, of which those are taken that are known as
/// temperatures: heat of air and friction is scaled so that a skin that does not react is hotter by as much.
std::vector<RaisedLaunch> raised_launches(const Study& study, const CaseOutcome& outcome,
                                          const GapVerdict& row, End end);

/// The skin with more heat from the air and from friction by these factors.
surface::SkinModel heated_more(surface::SkinModel skin, double friction, double air);

}  // namespace launchsafe::study
