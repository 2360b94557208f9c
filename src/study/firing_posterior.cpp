#include "launchsafe/study/calibration_record.hpp"

#include <boost/math/distributions/binomial.hpp>
#include <boost/math/tools/roots.hpp>

#include <cassert>

namespace launchsafe::study {
namespace {

/// Standard deviations from the centre of the prior to the end of its lattice.
constexpr double reach = 3.0;

double below(double z) { return 0.5 * std::erfc(-z / std::sqrt(2.0)); }

/// Of evenly spread values over `reach` standard deviations: where they lie, in standard deviations, and the
/// logarithm of the density there.
struct Node {
  double deviations = 0, log_density = 0;
};
std::vector<Node> nodes_of(int count) {
  std::vector<Node> nodes;
  for (int i = 0; i < count; ++i) {
    const double z = reach * (2.0 * i / (count - 1) - 1.0);
    nodes.push_back({z, -0.5 * z * z});
  }
  return nodes;
}

/// Of all rounds of a launch, whose heat has to grow by that margin until it ignites. A larger spread of
/// pressure and temperature must not speak for safety. A round that did not ignite may have been an average
/// or a cold one: the one that shows less counts. One that ignited counts as an average one.
double log_likelihood(const FiredLaunch& launch, double log_heat_margin, double scatter) {
  const double as_average = log_heat_margin / scatter;
  if (launch.ignited) return launch.rounds * std::log(below(-as_average));
  const double z = log_heat_margin / std::hypot(scatter, launch.log_heat_spread);
  return launch.rounds * std::log(below(std::max(z, as_average)));
}

/// Equally probable points of weighted ones: those at the middles of equal parts of the cumulated weight.
Posterior evenly_weighted(const Posterior& all, const std::vector<double>& weights, std::size_t points) {
  const double sum = std::accumulate(weights.begin(), weights.end(), 0.0);
  Posterior chosen;
  double cumulated = 0.0;
  for (std::size_t i = 0; i < all.size(); ++i) {
    cumulated += weights[i] / sum;
    while (chosen.size() < points &&
           cumulated > (static_cast<double>(chosen.size()) + 0.5) / static_cast<double>(points))
      chosen.push_back(all[i]);
  }
  return chosen;
}

}  // namespace

FiringPrior FiringPrior::widened(double factor) const {
  FiringPrior wide = *this;
  for (double* width :
       {&wide.log_localisation, &wide.log_exchange_time, &wide.ignition_temperature, &wide.log_scatter})
    *width *= factor;
  return wide;
}

surface::Extent FiringPrior::ignition_temperatures() const {
  const double half = reach * ignition_temperature;
  return {std::max(least_ignition_temperature, centre.ignition_temperature - half),
          centre.ignition_temperature + half};
}

surface::Extent FiringPrior::log_products() const {
  const double middle = std::log(centre.localisation * centre.exchange_time);
  const double half = reach * (log_localisation + log_exchange_time);
  return {middle - half, middle + half};
}

Posterior posterior_of(const FiringPrior& prior, const std::vector<FiredLaunch>& launches, int nodes,
                       std::size_t points) {
  assert(nodes >= 5);
  const std::vector<Node> many = nodes_of(nodes), few = nodes_of(nodes / 2 + 1);
  Posterior all;
  std::vector<double> logarithms;
  for (const Node& localisation : many) {
    for (const Node& exchange : many) {
      for (const Node& temperature : few) {
        const surface::SurfaceConstants constants{
            prior.centre.localisation * std::exp(localisation.deviations * prior.log_localisation),
            prior.centre.exchange_time * std::exp(exchange.deviations * prior.log_exchange_time),
            prior.centre.ignition_temperature + temperature.deviations * prior.ignition_temperature};
        if (constants.ignition_temperature < prior.least_ignition_temperature) continue;
        const std::vector<double> margins = of_each(
            launches, [&](const FiredLaunch& each) { return each.boundary.log_heat_margin(constants); });
        for (const Node& scatter : few) {
          const PosteriorPoint point{constants,
                                     prior.scatter * std::exp(scatter.deviations * prior.log_scatter)};
          double logarithm =
              localisation.log_density + exchange.log_density + temperature.log_density + scatter.log_density;
          for (std::size_t i = 0; i < launches.size(); ++i)
            logarithm += log_likelihood(launches[i], margins[i], point.scatter);
          all.push_back(point);
          logarithms.push_back(logarithm);
        }
      }
    }
  }
  const double largest = *std::ranges::max_element(logarithms);
  if (!std::isfinite(largest)) return {};
  for (double& each : logarithms) each = std::exp(each - largest);
  return evenly_weighted(all, logarithms, points);
}

std::optional<surface::IgnitionBoundary> boundary_for(const Posterior& posterior,
                                                      const surface::SkinModel& model,
                                                      const trace::BottomTrace& trace, double gap) {
  std::vector<surface::SurfaceConstants> all{surface::constants_of(model)};
  for (const PosteriorPoint& each : posterior) all.push_back(each.constants);
  surface::Extent products, temperatures;
  for (const surface::SurfaceConstants& each : all) {
    products.include(std::log(each.localisation * each.exchange_time));
    temperatures.include(each.ignition_temperature);
  }
  return surface::IgnitionBoundary::find(model, trace, gap, products, temperatures);
}

std::vector<double> ignition_probabilities(const Posterior& posterior,
                                           const surface::IgnitionBoundary& boundary,
                                           double log_heat_spread) {
  return of_each(posterior, [&](const PosteriorPoint& each) {
    return below(-boundary.log_heat_margin(each.constants) / std::hypot(each.scatter, log_heat_spread));
  });
}

double tail_probability(const std::vector<double>& probabilities, int ignited, int rounds) {
  double no_more = 0.0, no_fewer = 0.0;
  for (const double probability : probabilities) {
    const boost::math::binomial_distribution<double> of_rounds(rounds, probability);
    no_more += cdf(of_rounds, ignited);
    no_fewer += ignited > 0 ? cdf(complement(of_rounds, ignited - 1)) : 1.0;
  }
  return std::min(no_more, no_fewer) / static_cast<double>(probabilities.size());
}

double heat_factor(const Posterior& posterior, const surface::IgnitionBoundary& boundary,
                   const surface::SurfaceConstants& constants) {
  if (posterior.empty()) return math::infinity;
  std::vector<double> margins;
  for (const PosteriorPoint& each : posterior) margins.push_back(boundary.log_heat_margin(each.constants));
  // The share of rounds whose margin is below a value, over all points.
  const auto excess = [&](double value) {
    double share = 0.0;
    for (std::size_t i = 0; i < posterior.size(); ++i)
      share += below((value - margins[i]) / posterior[i].scatter);
    return share / static_cast<double>(posterior.size()) - firing_risk;
  };
  constexpr double deviations = 10.0;
  const double scatter = std::ranges::max(posterior, {}, &PosteriorPoint::scatter).scatter;
  const auto [least, largest] = std::ranges::minmax_element(margins);
  std::uintmax_t iterations = 200;
  const auto [from, to] = boost::math::tools::toms748_solve(
      excess, *least - deviations * scatter, *largest + deviations * scatter,
      boost::math::tools::eps_tolerance<double>(30), iterations);
  return std::max(1.0, std::exp(boundary.log_heat_margin(constants) - from));
}

double quantile_of(std::vector<double> values, double share) {
  if (values.empty()) return math::not_a_number;
  std::ranges::sort(values);
  const double place = share * static_cast<double>(values.size() - 1);
  const auto lower = static_cast<std::size_t>(place);
  const std::size_t upper = std::min(lower + 1, values.size() - 1);
  return values[lower] + (place - static_cast<double>(lower)) * (values[upper] - values[lower]);
}

}  // namespace launchsafe::study
