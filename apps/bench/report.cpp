#include "apps/bench/report.h"

#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace copeel::bench {
namespace {

using Json = nlohmann::ordered_json;

constexpr const char* kReference =
    "The reference is the cpu back end's method tile with every order of depths decided exactly. The project's tests prove that one against exact "
    "references (exact fragments, exact Booleans), which this program does not link. Pixels whose centre lies within 1/256 pixel of a projected edge are left out; "
    "a pixel is wrong where a channel is off by more than half a level of 255. A frame is the whole way from a view to colours and depths in memory.";

// JSON has no infinity: what is infinite is null.
Json finite(double value) { return std::isfinite(value) ? Json(value) : Json(nullptr); }

Json toJson(const Entry& e) {
  Json json{{"scene", e.scene}, {"method", e.method}, {"backend", e.backend}, {"robust", e.robust}, {"width", e.width}, {"height", e.height}};
  if (e.parameter > 0) json["parameter"] = e.parameter;
  if (!e.failure.empty()) {
    json["failure"] = e.failure;
    return json;
  }
  json["ms"] = {{"min", e.minMs}, {"median", e.medianMs}, {"frames", e.frames}};
  json["passes"] = e.stats.passes;
  json["bytes"] = e.stats.methodBytes;
  json["triangles"] = e.stats.triangles;
  json["fragments"] = e.stats.fragments;
  json["fragments_captured"] = e.stats.fragmentsCaptured;
  json["rh"] = e.stats.rh();
  json["overflow"] = e.stats.overflow;
  json["depth_complexity_max"] = e.stats.depthComplexityMax;
  json["wrong_pixels"] = e.error.wrong;
  json["wrong_on_edges"] = e.error.wrongOnEdges;
  json["compared_pixels"] = e.error.compared;
  json["psnr"] = finite(e.error.psnr);
  json["depth_error"] = finite(e.error.depth);
  if (!e.stats.objectsDrawn.empty()) json["objects_drawn"] = e.stats.objectsDrawn;
  if (!e.picture.empty()) json["picture"] = "pictures/" + e.picture, json["error_map"] = "pictures/" + e.errorMap;
  return json;
}

Json toJson(const std::vector<Entry>& entries) {
  Json list = Json::array();
  for (const Entry& e : entries) list.push_back(toJson(e));
  return list;
}

std::string decibels(double psnr) { return std::isfinite(psnr) ? fmt::format("{:.1f}", psnr) : "∞"; }
std::string lengthOf(double depth) { return std::isfinite(depth) ? fmt::format("{:.2g}", depth) : "∞"; }

std::string escaped(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '<') out += "&lt;";
    else if (c == '>') out += "&gt;";
    else if (c == '&') out += "&amp;";
    else if (c == '"') out += "&quot;";
    else out += c;
  }
  return out;
}

std::string cells(const Entry& e, const char* open, const char* close) {
  if (!e.failure.empty()) return fmt::format("{}{}{}", open, escaped(e.failure), close);
  std::string text;
  for (const std::string& cell : {fmt::format("{:.2f}", e.minMs), fmt::format("{:.2f}", e.medianMs), fmt::format("{}", e.stats.passes),
                                  fmt::format("{:.2f}", double(e.stats.methodBytes) / (1 << 20)), fmt::format("{:.4f}", e.stats.rh()), fmt::format("{}", e.stats.overflow),
                                  fmt::format("{}", e.error.wrong), decibels(e.error.psnr), lengthOf(e.error.depth)}) {
    text += open + cell + close;
  }
  return text;
}

std::string htmlTable(const std::vector<Entry>& entries) {
  std::string text = "<table><tr><th>method<th>back end<th>ms, least<th>ms, median<th>passes<th>MiB<th>R_h<th>overflow<th>wrong pixels<th>PSNR, dB<th>depth error</tr>\n";
  for (const Entry& e : entries) text += fmt::format("<tr><td>{}<td>{}{}</tr>\n", escaped(e.method), e.backend, cells(e, "<td>", ""));
  return text + "</table>\n";
}

std::string htmlPictures(const std::vector<Entry>& entries) {
  std::string text = "<details><summary>Pictures and where they are wrong</summary><div class=pictures>\n";
  for (const Entry& e : entries) {
    if (e.picture.empty()) continue;
    text += fmt::format("<figure><img loading=lazy src=\"pictures/{}\"><img loading=lazy src=\"pictures/{}\"><figcaption>{}: {} wrong</figcaption></figure>\n", e.picture, e.errorMap,
                        escaped(e.method), e.error.wrong);
  }
  return text + "</div></details>\n";
}

std::string htmlTable2011(const std::vector<Row2011>& rows) {
  std::string text = "<h2>The table of 2011</h2>\n<p>Coincident copies of closed shells of 8 layers; K = 8; the poster's numbers in brackets. f2b and f2b-kb-zf count one pass more, which finds "
                     "that nothing is left.</p>\n<table><tr><th>method<th>copies<th>fragments peeled, fullest pixel<th>accuracy, %<th>passes</tr>\n";
  for (const Row2011& r : rows) {
    text += fmt::format("<tr><td>{}<td>{}<td>{} ({})<td>{:.1f} ({:.1f})<td>{} ({})</tr>\n", r.method, r.copies, r.peeled, r.paperPeeled, r.accuracy, r.paperAccuracy, r.passes, r.paperPasses);
  }
  return text + "</table>\n";
}

std::string htmlPeers(const Report& report) {
  std::string text = fmt::format("<h2>A peer: VTK's dual depth peeling</h2>\n<p>{}</p>\n", escaped(report.peerNote));
  if (report.peers.empty()) return text;
  text += "<table><tr><th>peer<th>coincident copies<th>ms, least<th>ms, median<th>R_h, from its picture<th>ms of ours (tile)<th>ratio</tr>\n";
  for (const PeerEntry& p : report.peers) {
    text += fmt::format("<tr><td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{:.4f}<td>{:.2f}<td>{:.0f}</tr>\n", escaped(p.name), p.copies, p.minMs, p.medianMs, p.rh, p.tileMs,
                        p.tileMs > 0 ? p.minMs / p.tileMs : 0);
  }
  return text + "</table>\n";
}

constexpr const char* kHead = R"(<!doctype html><html lang=en><meta charset=utf-8><title>Copeel: speed against error</title>
<style>body{font:15px/1.45 sans-serif;max-width:1000px;margin:2em auto;padding:0 1em;color:#222}table{border-collapse:collapse;margin:1em 0;font-variant-numeric:tabular-nums}
td,th{padding:.15em .7em;text-align:right;border-bottom:1px solid #ddd}td:first-child,th:first-child{text-align:left}img{max-width:100%}
.pictures{display:flex;flex-wrap:wrap;gap:12px}figure{margin:0;width:48%}figure img{width:49%}figcaption{font-size:13px}summary{cursor:pointer}</style>
<h1>Copeel: speed against error</h1>
)";

}  // namespace

std::string toText(const std::vector<Entry>& entries) {
  std::string text = fmt::format("{:<8} {:<16} {:>9} {:>9} {:>6} {:>8} {:>7} {:>9} {:>7} {:>6} {:>8}\n", "scene", "method", "ms least", "median", "passes", "MiB", "R_h", "overflow", "wrong",
                                 "PSNR", "depth");
  for (const Entry& e : entries) {
    text += fmt::format("{:<8} {:<16} ", e.scene, e.method);
    if (!e.failure.empty()) text += e.failure + "\n";
    else text += fmt::format("{:>9.2f} {:>9.2f} {:>6} {:>8.2f} {:>7.4f} {:>9} {:>7} {:>6} {:>8}\n", e.minMs, e.medianMs, e.stats.passes, double(e.stats.methodBytes) / (1 << 20), e.stats.rh(),
                             e.stats.overflow, e.error.wrong, decibels(e.error.psnr), lengthOf(e.error.depth));
  }
  return text;
}

std::string toJson(const Report& report) {
  Json json{{"reference", kReference}, {"scenes", Json::array()}};
  for (const SceneRun& scene : report.scenes) json["scenes"].push_back({{"name", scene.name}, {"title", scene.title}, {"methods", toJson(scene.entries)}});
  json["over_resolution"] = toJson(report.overResolution);
  json["over_coplanarity"] = toJson(report.overCopies);
  json["over_depth_complexity"] = toJson(report.overShells);
  json["culling"] = toJson(report.culling);
  json["table_2011"] = Json::array();
  for (const Row2011& r : report.table) {
    json["table_2011"].push_back({{"method", r.method}, {"copies", r.copies}, {"peeled", r.peeled}, {"accuracy", r.accuracy}, {"passes", r.passes},
                                  {"paper", {{"peeled", r.paperPeeled}, {"accuracy", r.paperAccuracy}, {"passes", r.paperPasses}}}});
  }
  json["peers"] = Json::array();
  for (const PeerEntry& p : report.peers) {
    json["peers"].push_back({{"name", p.name}, {"copies", p.copies}, {"ms", {{"min", p.minMs}, {"median", p.medianMs}}}, {"rh", p.rh}, {"tile_ms", p.tileMs}});
  }
  json["peer_note"] = report.peerNote;
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string toHtml(const Report& report) {
  std::string text = kHead + fmt::format("<p>{}</p>\n", kReference);
  if (!report.plotNote.empty()) text += fmt::format("<p>{}</p>\n", escaped(report.plotNote));
  for (const std::string& plot : report.plots) text += fmt::format("<p><img src=\"plots/{}\"></p>\n", plot);
  if (!report.table.empty()) text += htmlTable2011(report.table);
  text += htmlPeers(report);
  for (const SceneRun& scene : report.scenes) {
    text += fmt::format("<h2>{}: {}</h2>\n", escaped(scene.name), escaped(scene.title)) + htmlTable(scene.entries) + htmlPictures(scene.entries);
  }
  return text;
}

}  // namespace copeel::bench
