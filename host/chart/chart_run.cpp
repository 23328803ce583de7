// See chart_run.hpp.
#include "chart/chart_run.hpp"

#include <algorithm>
#include <cstdio>
#include <map>
#include <utility>

#include "base/error.hpp"
#include "base/interrupt.hpp"
#include "base/number_text.hpp"
#include "base/stopwatch.hpp"
#include "chart/analysis.hpp"
#include "film/film_compare.hpp"
#include "plan/scene_hash.hpp"

namespace brume {

namespace {

constexpr int WITNESSES = 256;
constexpr int PLAIN_EXACT_SPP = 256;  // of a scene without media, whose only error is that of few samples

// The exact picture has the samples of the point, so that an error is the method's alone and not that of the edges.
int exact_spp(const Knobs& knobs) { return knobs.method == METHOD_NONE ? PLAIN_EXACT_SPP : knobs.spp; }

// The one method that is exact for a density which its light is not.
const std::string EXACT_FOR_DENSITIES = "dda_gauss2";

class Run {
 public:
  Run(ChartScene& scene, const ChartFolder& folder, const ChartIdentity& identity, const ChartRequest& request)
      : scene_(scene), folder_(folder), request_(request) {
    chart_ = folder.kept();
    chart_.identity = identity;
    list_ = knobs_list(request.methods, scene.limits(), scene.desc().film.spp);
    for (const Knobs& knobs : list_)
      if (!known(knobs)) left_.push_back(knobs);
    knobs_order(left_, scene.desc().film.spp, [&](const Knobs& knobs) { return scene.cost(knobs); });
    for (const Knobs& knobs : left_) cost_all_ += scene.cost(knobs);
  }

  Chart run() {
    if (!left_.empty() && begin()) {
      for (const Knobs& knobs : left_)
        if (!point_add(knobs)) break;
    }
    if (chart_.points.empty() && !interrupt_requested())
      throw InputError("--budget: " + number_text(request_.budget) + " s are too few for one point: " +
                       (exact_seconds_ > 0 ? "the exact picture alone took " + number_text(exact_seconds_, 2) + " s"
                                           : "the exact picture alone takes longer") +
                       "; allowed: more seconds, a smaller --size");
    return std::move(chart_);
  }

 private:
  bool known(const Knobs& knobs) const {
    return std::any_of(chart_.points.begin(), chart_.points.end(),
                       [&](const ChartPoint& p) { return knobs_id(p.knobs) == knobs_id(knobs); });
  }

  bool in_time() const { return request_.budget <= 0 || watch_.seconds() < request_.budget; }
  bool go_on() const {
    request_.progress(cost_all_ > 0 ? cost_done_ / cost_all_ : 1);
    return !interrupt_requested() && in_time();
  }

  // The exact picture as the scene asks for it, and its witnesses. False where there was no time.
  bool begin() {
    const int spp = request_.methods.empty() ? PLAIN_EXACT_SPP : scene_.desc().film.spp;
    if (!exact_picture(spp)) return false;
    if (chart_.exact.pixels > 0) return true;
    WitnessOptions options;
    constexpr int EDGES_ORDER = 8;  // shadows of surfaces end inside of cells
    if (!scene_.desc().shapes.empty()) options.order = EDGES_ORDER;
    if (request_.budget > 0) options.seconds = std::min(options.seconds, request_.budget / 4);
    const PlannedScene& scene = scene_.exact_scene(spp);
    const Witnesses witnesses = witnesses_ask(scene, witnesses_draw(exact_[spp], scene.frame, WITNESSES, 1), options);
    ChartExact& exact = chart_.exact;
    exact.method = scene_.exact_method();
    exact.spp = spp;
    exact.seconds = exact_seconds_;
    static_cast<WitnessError&>(exact) = witnesses_compare(witnesses, scene.frame, exact_[spp]);
    return exact_refine(spp, witnesses) && go_on();
  }

  // Takes the picture of fine steps where witnesses say that it is closer. A chart whose time is bounded does without
  // where it would take a large part of that.
  bool exact_refine(int spp, const Witnesses& witnesses) {
    constexpr double DEARER = 20, SHARE = 0.25;
    const bool dear = request_.budget > 0 && DEARER * exact_seconds_ > SHARE * request_.budget;
    if (chart_.exact.method.find(EXACT_FOR_DENSITIES) == std::string::npos || dear) return true;
    const SceneDesc fine = exact_desc_fine(scene_.desc(), spp, scene_.limits());
    auto picture = scene_.render_once(fine, [this](double) { return go_on(); });
    if (!picture) return false;
    ChartExact exact = chart_.exact;
    exact.method = "march_midpoint, step " + number_text(fine.render.step, 3);
    exact.seconds = picture->seconds;
    static_cast<WitnessError&>(exact) = witnesses_compare(witnesses, scene_.exact_scene(spp).frame, picture->image);
    if (exact.rel_rmse < chart_.exact.rel_rmse) {
      chart_.exact = exact;
      exact_[spp] = std::move(picture->image);
    }
    return true;
  }

  const Image* exact_picture(int spp) {
    const auto found = exact_.find(spp);
    if (found != exact_.end()) return &found->second;
    const Frame& frame = scene_.exact_scene(spp).frame;
    if (auto image = folder_.exact_read(spp, frame.crop_x1 - frame.crop_x0, frame.crop_y1 - frame.crop_y0))
      return &(exact_[spp] = std::move(*image));
    auto picture = scene_.render_once(exact_desc(scene_.desc(), spp), [this](double) { return go_on(); });
    if (!picture) return nullptr;
    exact_seconds_ = picture->seconds;
    unwritten_.push_back(spp);
    return &(exact_[spp] = std::move(picture->image));
  }

  // False where it is time to stop.
  bool point_add(const Knobs& knobs) {
    const Image* exact = exact_picture(exact_spp(knobs));
    if (!exact) return false;
    ChartPoint point;
    point.knobs = knobs;
    try {
      const auto picture = scene_.render_timed(knobs_apply(scene_.desc(), knobs), [this](double) { return go_on(); });
      if (!picture) return false;
      point.seconds = picture->seconds;
      point.seconds_spread = picture->seconds_spread;
      point.runs = picture->runs;
      point.build_seconds = picture->build_seconds;
      point.lookups = picture->lookups;
      const CompareResult error = image_compare(picture->image, *exact);
      point.rel_rmse = error.rel_rmse;
      point.error_rank = error_rank(picture->expected_error, picture->image, *exact);
      point.max_abs = error.max_abs;
      point.display = error.display_p99;
      folder_.point_write(knobs, picture->image, *exact, scene_.desc().film);
    } catch (const InputError& error) {  // a setting that this scene refuses
      request_.say("note: " + knobs_id(knobs) + " is left out: " + error.what());
      cost_done_ += scene_.cost(knobs);
      return true;
    }
    keep(point);
    return go_on();
  }

  void keep(const ChartPoint& point) {
    cost_done_ += scene_.cost(point.knobs);
    chart_.points.push_back(point);
    for (const int spp : unwritten_) {
      folder_.exact_write(spp, exact_[spp]);
      if (spp == chart_.exact.spp) folder_.exact_show(exact_[spp], scene_.desc().film);
    }
    unwritten_.clear();
    order_points();
    const double floor = chart_.exact.rel_rmse;
    pareto_mark(chart_.points, floor);
    chart_.orders = orders_fit(chart_.points, floor);
    chart_.missing = 0;
    for (const Knobs& knobs : list_) chart_.missing += !known(knobs);
    folder_.json_write(chart_);
  }

  // By method, then as in the list; those of an earlier run with other --methods behind.
  void order_points() {
    std::map<std::string, std::size_t> places;
    for (const Knobs& knobs : list_) places.emplace(knobs_id(knobs), places.size());
    const auto place = [&](const ChartPoint& p) {
      const auto found = places.find(knobs_id(p.knobs));
      return std::make_pair(p.knobs.method, found == places.end() ? places.size() : found->second);
    };
    std::stable_sort(chart_.points.begin(), chart_.points.end(),
                     [&](const ChartPoint& a, const ChartPoint& b) { return place(a) < place(b); });
  }

  ChartScene& scene_;
  const ChartFolder& folder_;
  const ChartRequest& request_;
  Chart chart_;
  std::vector<Knobs> list_, left_;
  double cost_all_ = 0, cost_done_ = 0, exact_seconds_ = 0;
  std::map<int, Image> exact_;  // by samples per pixel
  std::vector<int> unwritten_;  // of those: a chart without a point leaves nothing
  Stopwatch watch_;
};

}  // namespace

ChartIdentity identity_of(ChartScene& scene, const std::string& device, const ChartOptions& options,
                          const std::string& version) {
  const SceneDesc& desc = scene.desc();
  const PlannedScene& exact = scene.exact_scene(desc.film.spp);
  char hash[20];
  std::snprintf(hash, sizeof hash, "%016llx", static_cast<unsigned long long>(scene_hash(exact)));
  const Frame& frame = exact.frame;
  return {desc.file.filename().string(),
          hash,
          {desc.film.size.x, desc.film.size.y},
          {frame.crop_x0, frame.crop_y0, frame.crop_x1, frame.crop_y1},
          desc.film.spp,
          desc.render.seed,
          device,
          options.lanes,
          options.generic,
          version};
}

Chart chart_run(ChartScene& scene, const ChartFolder& folder, const ChartIdentity& identity,
                const ChartRequest& request) {
  return Run(scene, folder, identity, request).run();
}

}  // namespace brume
