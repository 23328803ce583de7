// See runs.hpp.
#include "reference/runs.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>
#include <optional>

#include "reference/glass.hpp"
#include "reference/phase.hpp"
#include "reference/scatter_light.hpp"

namespace brume::reference {
namespace {

constexpr std::size_t SPAN = 4;
constexpr double FAINT = 1 / 4.0, UNASKED = 1 / 8.0;  // of the tolerance

double sum_of(const dvec3& v) { return v.x + v.y + v.z; }

// One light along a run.
class LightRun {
 public:
  LightRun(const Context& context, const Medium& medium, std::size_t light, const RayD& ray,
           const std::vector<RunPoint>& points, double inside, RunsBefore& before, Scattered& result)
      : context_(context),
        light_(light),
        ray_(ray),
        points_(points),
        tolerance_(medium.tolerance),
        inside_(inside),
        before_(before),
        result_(result),
        lit_(points.size()),
        passed_(points.size(), dvec3(0)) {
    const dvec3 sigma_s = vec_promote(medium.sigma_s);
    for (const RunPoint& point : points) {
      const LightSample sample = sample_at(weights_.size());
      const double phase = sample.shines() ? phase_eval(medium.phase, medium.g, glm::dot(sample.travel, -ray.dir)) : 0;
      weights_.push_back(sigma_s * sample.irradiance * phase * point.gain);
    }
  }

  dvec3 radiance() {
    const auto sends = [](const dvec3& weight) { return weight != dvec3(0); };
    const auto from = std::find_if(weights_.begin(), weights_.end(), sends);
    if (from == weights_.end()) return dvec3(0);
    const auto first = static_cast<std::size_t>(from - weights_.begin());
    const auto last =
        static_cast<std::size_t>(weights_.rend() - std::find_if(weights_.rbegin(), weights_.rend(), sends)) - 1;
    const dvec3 all = std::accumulate(from, weights_.end(), dvec3(0));
    if (before_.faint + sum_of(all) <= tolerance_ * UNASKED * before_.seen) {
      before_.faint += sum_of(all);
      result_.error += sum_of(all) / 6;
      return all / 2.0;
    }
    ask(first);
    const std::size_t span = is_faint(weight_between(first, last)) ? points_.size() : SPAN;
    for (std::size_t a = first; a < last; a += span) {
      const std::size_t b = std::min(a + span, last);
      ask(b);
      between(a, b);
    }
    dvec3 sum(0);
    for (std::size_t i = first; i <= last; ++i) sum += weights_[i] * passed_[i];
    if (context_.scene.lights[light_].type != LIGHT_SURFACE)
      for (std::size_t i = first; i < last; ++i) sum += edge_moves(i);
    return sum;
  }

 private:
  LightSample sample_at(std::size_t i) const {
    return light_at(context_.scene, context_.scene.lights[light_], ray_.at(points_[i].t), points_[i].places);
  }

  void ask(std::size_t i) {
    const LightSample sample = sample_at(i);
    passed_[i] = dvec3(1);
    lit_[i] = true;
    if (sample.distance == 0) return;
    const RayD shadow{ray_.at(points_[i].t), -sample.travel};
    const dvec3 surfaces = light_passes(context_.scene, context_.bounds, shadow, sample.reach);
    lit_[i] = surfaces != dvec3(0);
    if (surfaces == dvec3(0)) {
      passed_[i] = dvec3(0);
      result_.shadow_key += static_cast<uint>(light_ + 1);
      return;
    }
    const uint stream = (i % 2 ? STREAM_LIGHT_END : STREAM_LIGHT) + static_cast<uint>(light_);
    passed_[i] = surfaces * transmittance_of(media_tau(context_, shadow, sample.distance,
                                                       points_[i].random.child(stream), result_.lookups));
  }

  // Of the points strictly between two.
  dvec3 weight_between(std::size_t a, std::size_t b) const {
    dvec3 sum(0);
    for (std::size_t i = a + 1; i < b; ++i) sum += weights_[i];
    return sum;
  }
  bool is_faint(const dvec3& weight) const { return sum_of(weight) <= tolerance_ * FAINT * before_.seen; }

  // What a point stands for: half of its segment.
  struct Half {
    double begin, end;
    double before(double t) const { return end > begin ? std::clamp((t - begin) / (end - begin), 0.0, 1.0) : 0; }
  };
  Half half_of(std::size_t i) const {
    const std::size_t first = i - i % 2;
    const double middle = (points_[first].t + points_[first + 1].t) / 2;
    const double length = (points_[first + 1].t - points_[first].t) * std::sqrt(3.0) / 2;
    return i == first ? Half{middle - length, middle} : Half{middle, middle + length};
  }

  // What moves where a shadow begins or ends between points i and i + 1, of which one is lit: half a segment is lit up
  // to the edge, with the light of that point.
  dvec3 edge_moves(std::size_t i) const {
    const dvec3 sends = weights_[i] + weights_[i + 1];
    if (!lit_[i] || !lit_[i + 1] || *lit_[i] == *lit_[i + 1]) return dvec3(0);
    if (is_faint(sends * (passed_[i] + passed_[i + 1]))) return dvec3(0);
    const auto unblocked = [&](double t) {
      const LightSample sample = light_at(context_.scene, context_.scene.lights[light_], ray_.at(t), points_[i].places);
      return sample.distance == 0 ||
             light_passes(context_.scene, context_.bounds, {ray_.at(t), -sample.travel}, sample.reach) != dvec3(0);
    };
    const double edge = edge_between(unblocked, points_[i].t, points_[i + 1].t, *lit_[i]);
    const double first = half_of(i).before(edge), second = half_of(i + 1).before(edge);
    const dvec3& light = *lit_[i] ? passed_[i] : passed_[i + 1];
    const dvec3 moves = weights_[i + 1] * second - weights_[i] * (1 - first);
    return *lit_[i] ? moves * light : -moves * light;
  }

  // Points strictly between two that have been asked.
  void between(std::size_t a, std::size_t b) {
    if (b - a < 2) return;
    const dvec3 weight = weight_between(a, b);
    const double from = points_[a].t, to = points_[b].t;
    const auto line = [&](double t) { return passed_[a] + (passed_[b] - passed_[a]) * ((t - from) / (to - from)); };
    if (is_faint(weight)) {
      for (std::size_t i = a + 1; i < b; ++i) passed_[i] = line(points_[i].t);
      return;
    }
    const std::size_t m = (a + b) / 2;
    ask(m);
    const dvec3 mean = (passed_[a] + 2.0 * passed_[m] + passed_[b]) / 4.0, bend = passed_[m] - line(points_[m].t);
    const double off = sum_of(weight * glm::abs(bend));
    if (surfaces_stand_ && to - from > inside_ * 33 / 1024) {  // a shadow may lie between
      between(a, m);
      between(m, b);
      return;
    }
    if (off > tolerance_ * (before_.seen + sum_of(weight * mean))) {
      between(a, m);
      between(m, b);
      return;
    }
    result_.error += off / 3;
    // Lagrange's parabola
    const double over = points_[m].t;
    for (std::size_t i = a + 1; i < b; ++i) {
      const double t = points_[i].t;
      const dvec3 value = passed_[a] * ((t - over) * (t - to) / ((from - over) * (from - to))) +
                          passed_[m] * ((t - from) * (t - to) / ((over - from) * (over - to))) +
                          passed_[b] * ((t - from) * (t - over) / ((to - from) * (to - over)));
      if (i != m) passed_[i] = glm::clamp(value, 0.0, 1.0);
    }
  }

  const Context& context_;
  bool surfaces_stand_ = !context_.scene.shapes.empty() || !context_.scene.triangles.empty();
  std::size_t light_;
  const RayD& ray_;
  const std::vector<RunPoint>& points_;
  double tolerance_, inside_;
  RunsBefore& before_;
  Scattered& result_;
  std::vector<std::optional<bool>> lit_;  // V ≠ 0 of those that were asked
  std::vector<dvec3> weights_, passed_;   // of each point: what it sends if nothing is in the way; V · T
};

}  // namespace

dvec3 run_radiance(const Context& context, int index, const RayD& ray, const std::vector<RunPoint>& points,
                   double inside, RunsBefore& before, Scattered& result) {
  dvec3 sum(0);
  for (std::size_t light = 0; light < context.scene.lights.size(); ++light) {
    const dvec3 its =
        LightRun(context, context.media[static_cast<std::size_t>(index)], light, ray, points, inside, before, result)
            .radiance();
    sum += its;
    before.seen += sum_of(its);
  }
  return sum;
}

}  // namespace brume::reference
