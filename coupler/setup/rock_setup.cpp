#include "coupler/setup/rock_setup.hpp"

#include "common/json_values.hpp"

namespace dipper::setup {

using nlohmann::json;

json to_json(const RockSetup& setup) {
  json scales = json::array();
  for (const auto& s : setup.scales) {
    scales.push_back({{"name", s.name},
                      {"body", s.body},
                      {"p_WS", json_of(s.X_WS.p)},
                      {"R_WS", json_of(s.X_WS.R)},
                      {"min_m", json_of(s.box.min_m)},
                      {"max_m", json_of(s.box.max_m)}});
  }
  json resumed;  // null: not resumed
  if (setup.resumed) {
    resumed = json::array();
    for (const auto& w : *setup.resumed) {
      resumed.push_back({json_of(w.load.torque), json_of(w.load.force), json_of(w.V_WB_W.w),
                         json_of(w.V_WB_W.v)});
    }
  }
  json hold;  // null: off
  if (const auto& h = setup.hold)
    hold = {{"below_m_s", h->below_m_s}, {"rest_s", h->rest_s},   {"unbalance", h->unbalance},
            {"average_s", h->average_s}, {"layer_m", h->layer_m}, {"margin_m", h->margin_m},
            {"ahead_s", h->ahead_s},     {"check_s", h->check_s}, {"gather_s", h->gather_s},
            {"sight_s", h->sight_s}};
  json layer;  // null: none
  if (const auto& l = setup.layer) layer = {l->depth_m, l->rear_x_m, l->half_width_m};
  json crust;  // null: none
  if (setup.crust) crust = {setup.crust->above_m, setup.crust->thickness_m};
  json fall;  // null: none
  if (const auto& f = setup.fall)
    fall = {{"deck", f->deck}, {"at_step", f->at_step}, {"mass_kg", f->mass_kg}};
  json floor;  // floor is not cleared
  if (const auto& f = setup.floor) floor = {f->to_x_m, f->half_width_m, f->height_m};
  return {{"ranks", setup.ranks},
          {"fast_loop", setup.fast_loop},
          {"deck", setup.deck},
          {"variables", setup.variables},
          {"log", setup.log},
          {"screen", setup.screen},
          {"bodies", setup.bodies},
          {"resumed", resumed},
          {"image", setup.image},
          {"scales", scales},
          {"cleared", setup.cleared},
          {"crust", crust},
          {"fall", fall},
          {"pauses", setup.pauses},
          {"floor", floor},
          {"hold", hold},
          {"layer", layer}};
}

RockSetup rock_setup_from(const json& j) {
  RockSetup setup;
  setup.ranks = j.at("ranks");
  setup.deck = j.at("deck");
  setup.variables = j.at("variables").get<decltype(setup.variables)>();
  setup.log = j.at("log");
  setup.screen = j.at("screen");
  setup.bodies = j.at("bodies").get<std::vector<std::string>>();
  if (const auto& resumed = j.at("resumed"); !resumed.is_null()) {
    setup.resumed.emplace();
    for (const auto& w : resumed) {
      setup.resumed->push_back({{vector_from(w.at(0)), vector_from(w.at(1))},
                                {vector_from(w.at(2)), vector_from(w.at(3))}});
    }
  }
  if (const auto& crust = j.at("crust"); !crust.is_null()) {
    setup.crust = CrustZone{crust.at(0), crust.at(1)};
  }
  setup.fast_loop = j.at("fast_loop");
  setup.image = j.at("image");
  setup.cleared = j.at("cleared").get<std::vector<std::string>>();
  if (const auto& fall = j.at("fall"); !fall.is_null()) {
    setup.fall = RockFall{fall.at("deck"), fall.at("at_step"), fall.at("mass_kg")};
  }
  setup.pauses = j.at("pauses");
  if (const auto& floor = j.at("floor"); !floor.is_null())
    setup.floor = FloorStrip{floor.at(0), floor.at(1), floor.at(2)};
  if (const auto& layer = j.at("layer"); !layer.is_null())
    setup.layer = HeldLayer{layer.at(0), layer.at(1), layer.at(2)};
  if (const auto& hold = j.at("hold"); !hold.is_null()) {
    HoldSettings& h = setup.hold.emplace();
    h.below_m_s = hold.at("below_m_s");
    h.rest_s = hold.at("rest_s");
    h.unbalance = hold.at("unbalance");
    h.layer_m = hold.at("layer_m");
    h.average_s = hold.at("average_s");
    h.margin_m = hold.at("margin_m");
    h.ahead_s = hold.at("ahead_s");
    h.check_s = hold.at("check_s");
    h.gather_s = hold.at("gather_s");
    h.sight_s = hold.at("sight_s");
  }
  for (const auto& s : j.at("scales")) {
    setup.scales.push_back({s.at("name"),
                            s.at("body"),
                            {quaternion_from(s.at("R_WS")), vector_from(s.at("p_WS"))},
                            {vector_from(s.at("min_m")), vector_from(s.at("max_m"))}});
  }
  return setup;
}

}  // namespace dipper::setup
