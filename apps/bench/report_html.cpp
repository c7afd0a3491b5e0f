// index.html: the limits, the plots, the tables, then each scene with its pictures and where they are wrong. One file beside its pictures, no script, no network.
#include <fmt/format.h>

#include "apps/bench/reference_note.h"
#include "apps/bench/report.h"

namespace copeel::bench {
namespace {

constexpr const char* kHead = R"(<!doctype html><html lang=en><meta charset=utf-8><meta name=viewport content="width=device-width"><title>Copeel: speed against error</title>
<style>
:root{--ink:#1d2733;--soft:#5c6b7a;--line:#e3e8ee;--blue:#0072b2;--orange:#d55e00;--green:#00805c}
*{box-sizing:border-box}body{font:15px/1.5 system-ui,sans-serif;color:var(--ink);background:#f5f7f9;margin:0}
main{max-width:1080px;margin:0 auto;padding:1px 18px 60px}header{background:#14202c;color:#fff;padding:26px 18px}header>*{max-width:1044px;margin:0 auto}
header h1{font-size:28px;margin:0}header p{color:#b9c6d3;margin-top:6px}nav{position:sticky;top:0;background:#fffd;backdrop-filter:blur(6px);border-bottom:1px solid var(--line);z-index:1}
nav div{max-width:1080px;margin:0 auto;padding:9px 18px;display:flex;flex-wrap:wrap;gap:4px 18px}a{color:var(--blue);text-decoration:none}a:hover{text-decoration:underline}
section{background:#fff;border:1px solid var(--line);border-radius:10px;padding:4px 22px 18px;margin:22px 0;overflow-x:auto;scroll-margin-top:56px}h2{font-size:20px;margin:.8em 0 .3em}
p.note,figcaption{color:var(--soft);font-size:13.5px}figure{margin:14px 0}img{max-width:100%;height:auto;display:block}
table{border-collapse:collapse;margin:12px 0;font-variant-numeric:tabular-nums;font-size:14px;min-width:60%}th{color:var(--soft);font-weight:600;vertical-align:bottom}
td,th{padding:.2em .75em;text-align:right;border-bottom:1px solid var(--line)}td:first-child,th:first-child{text-align:left;padding-left:0}tr:hover td{background:#f4f8fb}
td.why{text-align:left;color:var(--soft)}td.text{text-align:left}.bad{color:var(--orange);font-weight:600}.good{color:var(--green)}.robust::before{content:"●";color:var(--blue);margin-right:.45em}
.lossy::before{content:"■";color:var(--orange);margin-right:.45em}details{margin-top:8px}summary{cursor:pointer;color:var(--blue)}
.pictures{display:grid;grid-template-columns:repeat(auto-fill,minmax(300px,1fr));gap:16px;margin-top:12px}.pictures figure{margin:0}.pictures div{display:grid;grid-template-columns:1fr 1fr;gap:2px}
.pictures img{width:100%;border:1px solid var(--line)}
</style>
)";

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

std::string marked(bool bad, const std::string& text) { return bad ? "<span class=bad>" + text + "</span>" : text; }

std::string section(const std::string& id, const std::string& title, const std::string& body) { return fmt::format("<section id=\"{}\"><h2>{}</h2>\n{}</section>\n", id, title, body); }

std::string rowOf(const Entry& e) {
  std::string text = fmt::format("<tr><td><span class={}>{}</span><td>{}", e.robust ? "robust" : "lossy", escaped(e.method), e.backend);
  if (!e.measured()) return text + fmt::format("<td class=why colspan=9>{}</tr>\n", escaped(e.failure + e.leftOut));
  return text + fmt::format("<td>{:.2f}<td>{:.2f}<td>{}<td>{:.2f}<td>{}<td>{}<td>{}<td>{}<td>{}</tr>\n", e.minMs, e.medianMs, e.stats.passes, double(e.stats.methodBytes) / (1 << 20),
                            marked(e.stats.rh() < 1, fmt::format("{:.4f}", e.stats.rh())), marked(e.stats.overflow > 0, fmt::format("{}", e.stats.overflow)),
                            marked(e.error.wrong > 0, fmt::format("{}", e.error.wrong)), decibels(e.error.psnr), lengthOf(e.error.depth));
}

std::string tableOf(const std::vector<Entry>& entries) {
  std::string text = "<table><tr><th>method<th>back end<th>ms, least<th>ms, median<th>passes<th>MiB<th>R<sub>h</sub><th>overflow<th>wrong pixels<th>PSNR, dB<th>depth error</tr>\n";
  for (const Entry& e : entries) text += rowOf(e);
  return text + "</table>\n";
}

std::string picturesOf(const std::vector<Entry>& entries) {
  std::string text = "<details><summary>Pictures, and where they are wrong</summary><p class=note>Right of each picture its error: grey where right, from yellow (half a level) to red (64 levels and "
                     "more) where wrong, blue on edges that differ.</p><div class=pictures>\n";
  for (const Entry& e : entries) {
    if (e.picture.empty()) continue;
    text += fmt::format("<figure><div><img loading=lazy alt=\"\" src=\"pictures/{}\"><img loading=lazy alt=\"\" src=\"pictures/{}\"></div><figcaption>{}: {} wrong</figcaption></figure>\n", e.picture,
                        e.errorMap, escaped(e.method), e.error.wrong);
  }
  return text + "</div></details>\n";
}

std::string limitsTable(const std::vector<Limit>& limits) {
  std::string text = fmt::format("<p>{}</p><details><summary>All limits</summary><table><tr><th>of<th class=text>figure<th>value<th>limit<th></tr>\n", escaped(toText(limits).substr(0, toText(limits).find('\n'))));
  for (const Limit& l : limits) {
    text += fmt::format("<tr><td>{}<td class=text>{}<td>{:.4g}<td>{} {:.3g}<td>{}</tr>\n", escaped(l.subject), escaped(l.what), l.value, l.atLeast ? "≥" : "≤", l.limit,
                        l.holds() ? "<span class=good>holds</span>" : "<span class=bad>missed</span>");
  }
  return text + "</table></details>\n";
}

std::string speedTable(const SpeedRun& speed) {
  std::string text = fmt::format("<p class=note>1280 × 720, two threads, a picture alone a frame. {}</p>\n", escaped(speed.peerNote));
  for (const SpeedScene& scene : speed.scenes) {
    text += fmt::format("<table><tr><th>{}: {}<th>ms, least<th>ms, median<th>frames</tr>\n", escaped(scene.name), escaped(scene.title));
    for (const Entry& e : scene.entries) {
      text += fmt::format("<tr><td>{}", escaped(e.method));
      text += e.measured() ? fmt::format("<td>{:.2f}<td>{:.2f}<td>{}</tr>\n", e.minMs, e.medianMs, e.frames) : fmt::format("<td class=why colspan=3>{}</tr>\n", escaped(e.failure + e.leftOut));
    }
    if (scene.vtkMs > 0) text += fmt::format("<tr><td>VTK, dual depth peeling<td>{:.2f}<td><td></tr>\n", scene.vtkMs);
    text += "</table>\n";
  }
  return text;
}

std::string table2011Of(const std::vector<Row2011>& rows) {
  std::string text = fmt::format("<p class=note>Coincident copies of generated closed shells of 8 layers; K = 8; the poster's numbers in brackets. {}</p>\n<table><tr><th>method<th>copies<th>fragments "
                                 "peeled<th>accuracy, %<th>passes<th>ms</tr>\n", kLegend2011);
  for (const Row2011& r : rows) {
    text += fmt::format("<tr><td>{}<td>{}", r.method, r.copies);
    if (!r.leftOut.empty()) text += fmt::format("<td class=why colspan=4>{}</tr>\n", escaped(r.leftOut));
    else text += fmt::format("<td>{} ({})<td>{:.1f} ({:.1f})<td>{} ({})<td>{:.1f}</tr>\n", r.peeled, r.paperPeeled, r.accuracy, r.paperAccuracy, r.passes, r.paperPasses, r.ms);
  }
  return text + "</table>\n";
}

std::string depthSourcesTable(const Report& report) {
  std::string rows;
  for (const SceneRun& scene : report.scenes) {
    for (const auto& [planes, hardware] : depthSourcesOf(scene.entries)) {
      rows += fmt::format("<tr><td>{}<td>{}<td>{}<td>{}<td>{:.4f}<td>{:.4f}<td>{:.4f}<td>{:.4f}</tr>\n", escaped(scene.name), escaped(planes->method), planes->error.wrong,
                          marked(hardware->error.wrong > planes->error.wrong, fmt::format("{}", hardware->error.wrong)), planes->stats.rh(), hardware->stats.rh(), planes->stats.cp(),
                          hardware->stats.cp());
    }
  }
  if (rows.empty()) return "";
  return "<p class=note>The papers take two fragments as coplanar where the rasterizer's depths are equal to the bit; here depth is a function of the face's plane. C<sub>p</sub>: share of covered "
         "pixels with coplanar fragments; R<sub>h</sub>: share of the fragments that the method delivers. A rasterizer that parts what is coplanar finds a smaller C<sub>p</sub>, and orders by noise.</p>\n"
         "<table><tr><th>scene<th>method<th>wrong pixels, planes<th>hardware<th>R<sub>h</sub>, planes<th>hardware<th>C<sub>p</sub>, planes<th>hardware</tr>\n" + rows + "</table>\n";
}

std::string peersTable(const Report& report) {
  std::string text = fmt::format("<p class=note>{}</p>\n", escaped(report.peerNote));
  if (report.peers.empty()) return text;
  text += "<table><tr><th>peer<th>coincident copies<th>ms, least<th>ms, median<th>R<sub>h</sub>, from its picture<th>ms of ours (tile)<th>ratio</tr>\n";
  for (const PeerEntry& p : report.peers) {
    text += fmt::format("<tr><td>{}<td>{}<td>{:.2f}<td>{:.2f}<td>{}<td>{:.2f}<td>{:.0f}</tr>\n", escaped(p.name), p.copies, p.minMs, p.medianMs, marked(p.rh < 0.99, fmt::format("{:.4f}", p.rh)), p.tileMs,
                        p.tileMs > 0 ? p.minMs / p.tileMs : 0);
  }
  return text + "</table>\n";
}

}  // namespace

std::string toHtml(const Report& report) {
  std::string body, links;
  const auto add = [&](const std::string& id, const std::string& title, const std::string& content) {
    body += section(id, title, content);
    links += fmt::format("<a href=\"#{}\">{}</a>", id, title);
  };
  const std::vector<Limit> limits = limitsOf(report);
  std::string plots = report.plotNote.empty() ? "" : fmt::format("<p>{}</p>\n", escaped(report.plotNote));
  for (const Plot& plot : report.plots) plots += fmt::format("<figure><img alt=\"\" src=\"plots/{}\"><figcaption>{}</figcaption></figure>\n", plot.file, escaped(plot.caption));
  for (const std::string& note : report.notes) plots += fmt::format("<p>{}</p>\n", escaped(note));
  add("plots", "Speed against error, and what it scales with", plots);
  if (!limits.empty()) add("limits", "Limits", limitsTable(limits));
  if (!report.speed.scenes.empty()) add("speed", "Speed", speedTable(report.speed));
  if (const std::string sources = depthSourcesTable(report); !sources.empty()) add("depth", "Depth: of the plane, or of the rasterizer", sources);
  if (!report.table.empty()) add("t2011", "The table of 2011", table2011Of(report.table));
  if (report.table2013) add("t2013", "Table 1 of 2013, measured", htmlOf(*report.table2013));
  if (!report.peerNote.empty()) add("vtk", "VTK", peersTable(report));
  for (const SceneRun& scene : report.scenes) {
    const std::string title = escaped(scene.name) + ": " + escaped(scene.title);
    body += section("scene-" + escaped(scene.name), title, tableOf(scene.entries) + picturesOf(scene.entries));
    links += fmt::format("<a href=\"#scene-{0}\">{0}</a>", escaped(scene.name));
  }
  return kHead + fmt::format("<header><h1>Copeel: speed against error</h1><p>{}</p></header><nav><div>{}</div></nav><main>\n<p class=note>{} <span class=robust>robust: delivers every "
                             "fragment</span> &nbsp; <span class=lossy>approximate</span></p>\n", escaped(machineLine()), links, kReferenceNote) + body + "</main></html>\n";
}

}  // namespace copeel::bench
