// bench.json, and the tables as JSON.
#include <cmath>

#include <nlohmann/json.hpp>

#include "apps/bench/report.h"
#include "apps/bench/reference_note.h"

namespace copeel::bench {
namespace {

using Json = nlohmann::ordered_json;

// JSON has no infinity: what is infinite is null.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

void addCounts(Json& json, const Entry& e) {
  json["passes"] = e.stats.passes;
  json["bytes"] = e.stats.methodBytes;
  json["triangles"] = e.stats.triangles;
  json["fragments"] = e.stats.fragments;
  json["fragments_captured"] = e.stats.fragmentsCaptured;
  json["rh"] = e.stats.rh();
  json["cp"] = e.stats.cp();
  json["overflow"] = e.stats.overflow;
  json["depth_complexity_max"] = e.stats.depthComplexityMax;
  json["wrong_pixels"] = e.error.wrong;
  json["wrong_on_edges"] = e.error.wrongOnEdges;
  json["compared_pixels"] = e.error.compared;
  json["psnr"] = finite(e.error.psnr);
  json["depth_error"] = finite(e.error.depth);
  if (!e.stats.objectsDrawn.empty()) json["objects_drawn"] = e.stats.objectsDrawn;
  if (!e.picture.empty()) json["picture"] = "pictures/" + e.picture, json["error_map"] = "pictures/" + e.errorMap;
}

Json jsonOf(const Entry& e, bool counts = true) {
  Json json{{"scene", e.scene}, {"method", e.method}, {"backend", e.backend}, {"robust", e.robust}, {"width", e.width}, {"height", e.height}};
  if (e.parameter > 0) json["parameter"] = e.parameter;
  if (!e.failure.empty()) json["failure"] = e.failure;
  if (!e.leftOut.empty()) json["left_out"] = e.leftOut;
  if (!e.measured()) return json;
  json["ms"] = {{"min", e.minMs}, {"median", e.medianMs}, {"frames", e.frames}};
  if (counts) addCounts(json, e);
  return json;
}

Json jsonOf(const std::vector<Entry>& entries, bool counts = true) {
  Json list = Json::array();
  for (const Entry& e : entries) list.push_back(jsonOf(e, counts));
  return list;
}

Json jsonOf(const std::vector<Row2011>& rows) {
  Json list = Json::array();
  for (const Row2011& r : rows) {
    Json row{{"method", r.method}, {"copies", r.copies}};
    if (!r.leftOut.empty()) row["left_out"] = r.leftOut;
    else row.update({{"peeled", r.peeled}, {"accuracy", r.accuracy}, {"passes", r.passes}, {"ms", r.ms}});
    row["paper"] = {{"peeled", r.paperPeeled}, {"accuracy", r.paperAccuracy}, {"passes", r.paperPasses}};
    list.push_back(row);
  }
  return list;
}

Json number(double value) { return value < 0 ? Json(nullptr) : Json(value); }

Json jsonOf(const Table2013& table) {
  Json json{{"depths", table.depths}, {"coplanar", table.coplanar}, {"k", table.k}, {"width", table.width}, {"height", table.height}, {"methods", Json::array()}};
  for (const Row2013& r : table.rows) {
    Json row{{"method", r.method}};
    if (!r.leftOut.empty()) row["left_out"] = r.leftOut;
    row["passes"] = {{"formula", r.passesFormula}, {"expected", r.passesExpected}, {"measured", r.passes}};
    row["words_per_pixel"] = {{"paper", r.paperWords}, {"expected", number(r.wordsExpected)}, {"measured", r.words}};
    row["rh"] = {{"formula", r.rhFormula}, {"expected", number(r.rhExpected)}, {"measured", r.rh}};
    row["layers_per_iteration"] = number(r.layersPerIteration);
    row["ms"] = r.ms;
    json["methods"].push_back(row);
  }
  return json;
}

Json jsonOf(const SpeedRun& speed) {
  Json list = Json::array();
  for (const SpeedScene& scene : speed.scenes) {
    list.push_back({{"name", scene.name}, {"title", scene.title}, {"methods", jsonOf(scene.entries, false)}, {"vtk_ms", scene.vtkMs > 0 ? Json(scene.vtkMs) : Json(nullptr)}});
  }
  return list;
}

Json jsonOf(const std::vector<PeerEntry>& peers) {
  Json list = Json::array();
  for (const PeerEntry& p : peers) list.push_back({{"name", p.name}, {"copies", p.copies}, {"ms", {{"min", p.minMs}, {"median", p.medianMs}}}, {"rh", p.rh}, {"tile_ms", p.tileMs}});
  return list;
}

std::string textOf(const Json& json) { return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n"; }

}  // namespace

std::string toJson(const std::vector<Row2011>& rows) { return textOf(jsonOf(rows)); }
std::string toJson(const Table2013& table) { return textOf(jsonOf(table)); }

std::string toJson(const Report& report) {
  Json json{{"machine", machineLine()}, {"reference", kReferenceNote}, {"scenes", Json::array()}};
  for (const SceneRun& scene : report.scenes) json["scenes"].push_back({{"name", scene.name}, {"title", scene.title}, {"methods", jsonOf(scene.entries)}});
  json["over_resolution"] = jsonOf(report.overResolution.entries);
  json["over_coplanarity"] = jsonOf(report.overCopies.entries);
  json["over_depth_complexity"] = jsonOf(report.overDepth.entries);
  json["culling"] = jsonOf(report.culling);
  json["memory"] = jsonOf(report.memory.entries);
  json["limited_memory"] = {{"bytes", report.memoryLimit}, {"methods", jsonOf(report.limitedMemory.entries)}};
  json["stand_ins"] = {{"resolution", report.overResolution.of}, {"coplanarity", report.overCopies.of}, {"depth", report.overDepth.of}, {"culling", report.cullingOf}, {"memory", report.memory.of}};
  json["table_2011"] = jsonOf(report.table);
  if (report.table2013) json["table_2013"] = jsonOf(*report.table2013);
  json["speed"] = jsonOf(report.speed);
  json["peers"] = jsonOf(report.peers);
  json["peer_note"] = report.peerNote;
  json["notes"] = report.notes;
  json["limits"] = Json::array();
  for (const Limit& l : limitsOf(report)) {
    json["limits"].push_back({{"subject", l.subject}, {"what", l.what}, {"value", finite(l.value)}, {"limit", l.limit}, {"at_least", l.atLeast}, {"holds", l.holds()}});
  }
  return textOf(json);
}

}  // namespace copeel::bench
