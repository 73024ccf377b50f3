// SPDX-License-Identifier: GPL-3.0-or-later
// Each subcommand does its work and says so with the keys of docs/command_line.md.
#include <cmath>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "cli/cli_files.h"
#include "cli/run_argil.h"
#include "support/effort.h"
#include "support/scratch.h"
#include "support/shapes.h"

namespace argil::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// A folder with a project sculpted from kSmallScript.
class CliCommands : public testing::Test {
 protected:
  std::string path(const std::string& name) const { return (folder_ / name).string(); }

  json run_ok(std::vector<std::string> arguments) const {
    arguments.push_back("--json");
    const Ended run = run_argil(arguments);
    EXPECT_EQ(run.status, 0) << run.err;
    return run.json();
  }

  json sculpt(const std::vector<std::string>& more = {}) const {
    fill(path("s.strokes.jsonl"), kSmallScript);
    std::vector<std::string> arguments{"sculpt", "--strokes", path("s.strokes.jsonl"), "-o",
                                       path("p.vdb")};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_ok(arguments);
  }

  /// A ball about the origin as p.vdb.
  void make_ball_project(int radius_mm = 20) const {
    fill(path("ball.strokes.jsonl"),
         R"({"argil_strokes":1,"start":{"shape":"ball","voxel_mm":0.25,"radius_mm":)" +
             std::to_string(radius_mm) + "}}\n");
    ASSERT_EQ(
        run_argil({"sculpt", "--strokes", path("ball.strokes.jsonl"), "-o", path("p.vdb")}).status,
        0);
  }

  ScratchFolder folder_;
};

void expect_keys(const json& object, const std::vector<std::string>& keys) {
  for (const std::string& key : keys) EXPECT_TRUE(object.contains(key)) << key;
}

const std::vector<std::string> kCheckKeys{
    "printable",          "closed",     "manifold",   "outward",     "boundary_edges",
    "nonmanifold_edges",  "degenerate", "components", "euler",       "nonmanifold_vertices",
    "self_intersections", "volume_mm3", "area_mm2",   "min_wall_mm", "problems"};

TEST_F(CliCommands, ImportsAMeshToItsVolume) {
  fill(path("ball.obj"), obj_text(ball_mesh(10.0, 5)));
  const json report = run_ok(
      {"import", path("ball.obj"), "-o", path("b.vdb"), "--size-mm", "40", "--resolution", "80"});
  expect_keys(report, {"levels", "holes_closed", "volume_mm3", "seconds"});
  expect_keys(report["levels"][0], {"level", "voxel_mm", "active_voxels", "leaves", "bytes"});
  EXPECT_EQ(report["holes_closed"], 0);
  EXPECT_NEAR(report["levels"][0]["voxel_mm"], 0.5, 1e-9);
  const double volume = 4.0 / 3.0 * std::numbers::pi * 20.0 * 20.0 * 20.0;
  EXPECT_NEAR(report["volume_mm3"].get<double>(), volume, 0.01 * volume);
}

TEST_F(CliCommands, ImportSaysWhereTheClayIsNotTheMesh) {
  fill(path("plate.obj"), obj_text(box_mesh({10.0, 10.0, 0.2})));
  const Ended coarse =
      run_argil({"import", path("plate.obj"), "-o", path("p.vdb"), "--voxel-mm", "0.5", "--json"});
  ASSERT_EQ(coarse.status, 0) << coarse.err;
  EXPECT_NEAR(coarse.json()["mesh_volume_mm3"].get<double>(), 20.0, 1e-9);
  EXPECT_FALSE(coarse.json()["doubts"].empty());
  EXPECT_THAT(coarse.err, HasSubstr("mm3 and the mesh 20"));
  fill(path("block.obj"), obj_text(box_mesh({10.0, 10.0, 5.0})));
  const json fine = run_ok({"import", path("block.obj"), "-o", path("p.vdb"), "--voxel-mm", "0.1"});
  EXPECT_EQ(fine["doubts"], json::array());
}

TEST_F(CliCommands, ImportNamesTheGapThatItFilled) {
  fill(path("gap.obj"), obj_text(joined(box_mesh({5.0, 5.0, 5.0}, {-2.3, 0.0, 0.0}),
                                        box_mesh({5.0, 5.0, 5.0}, {2.8, 0.0, 0.0}))));
  const std::vector<std::string> coarse{"import",      path("gap.obj"), "-o",
                                        path("p.vdb"), "--voxel-mm",    "0.5"};
  std::vector<std::string> with_json = coarse;
  with_json.push_back("--json");
  const Ended run = run_argil(with_json);
  ASSERT_EQ(run.status, 0) << run.err;
  const json report = run.json();
  EXPECT_EQ(report["bodies"], 1);
  EXPECT_EQ(report["mesh_bodies"], 2);
  EXPECT_GT(report["filled"]["distance_mm"], 1.5);
  EXPECT_NEAR(report["filled"]["at_mm"][0].get<double>(), 0.25, 0.051);
  EXPECT_NEAR(report["merged"]["distance_mm"].get<double>(), 0.1, 0.01);
  EXPECT_THAT(run.err, HasSubstr("inside the clay: a gap or a cavity narrower than two voxels"));
  EXPECT_THAT(run.err, HasSubstr("'body 1' and 'body 2' are 0.1 mm apart at 0.25, "));
  EXPECT_THAT(run.err, HasSubstr("mm and are one body in the clay; choose a finer --voxel-mm"));
  ASSERT_EQ(report["fused"].size(), 1U);
  EXPECT_EQ(report["fused"][0]["parts"], (json{"body 1", "body 2"}));
  EXPECT_THAT(run_argil(coarse).out, HasSubstr("2 bodies of the mesh are 1 in clay"));
}

TEST_F(CliCommands, ImportTakesOverlapsForWhatTheyAre) {
  fill(path("two.obj"), obj_text(joined(ball_mesh(5.0, 4), ball_mesh(4.0, 4, {4.0, 0.5, 0.2}))));
  const json report =
      run_ok({"import", path("two.obj"), "-o", path("p.vdb"), "--voxel-mm", "0.25"});
  EXPECT_LT(report["volume_mm3"].get<double>(), 0.9 * report["mesh_volume_mm3"].get<double>());
  EXPECT_EQ(report["doubts"], json::array());
}

TEST_F(CliCommands, ClosesAHoleAndSaysSo) {
  fill(path("open.obj"), obj_text(without(ball_mesh(10.0, 4), 7)));
  const Ended run =
      run_argil({"import", path("open.obj"), "-o", path("b.vdb"), "--voxel-mm", "0.5"});
  EXPECT_EQ(run.status, 0) << run.err;
  EXPECT_THAT(run.out, HasSubstr("1 hole closed"));
}

TEST_F(CliCommands, InfoRepeatsWhatSculptSaved) {
  const json sculpted = sculpt();
  expect_keys(sculpted, {"strokes", "dabs", "dab_ms", "hash"});
  expect_keys(sculpted["dab_ms"], {"p50", "p99", "max"});
  EXPECT_EQ(sculpted["strokes"], 3);
  const json info = run_ok({"info", path("p.vdb")});
  expect_keys(info, {"levels", "bbox_mm", "volume_mm3", "area_mm2", "hash", "bytes"});
  EXPECT_EQ(info["hash"], sculpted["hash"]);
  ASSERT_EQ(info["levels"].size(), sculpted["levels"].size());
  for (std::size_t i = 0; i < info["levels"].size(); ++i) {
    for (const char* key : {"level", "voxel_mm", "active_voxels", "leaves"}) {
      EXPECT_EQ(info["levels"][i][key], sculpted["levels"][i][key]) << key;
    }
  }
  EXPECT_GT(info["bbox_mm"][1][2].get<double>(), 10.0);  // the ellipsoid on top of the ball of 8
}

TEST_F(CliCommands, SculptGivesTheSameHashForAnyThreadCount) {
  const json first = sculpt({"--threads", "1"});
  for (const char* threads : {"2", "4"}) {
    EXPECT_EQ(sculpt({"--threads", threads})["hash"], first["hash"]) << threads << " threads";
  }
}

TEST_F(CliCommands, UndoAllReturnsTheFirstHash) {
  const json report = sculpt({"--undo-all"});
  EXPECT_EQ(report["undone"], 3);
  EXPECT_EQ(report["hash"], report["start_hash"]);
  EXPECT_EQ(run_ok({"info", path("p.vdb")})["hash"], report["start_hash"]);
}

TEST_F(CliCommands, SculptContinuesAProject) {
  const json once = sculpt();
  const json twice =
      run_ok({"sculpt", path("p.vdb"), "--strokes", path("s.strokes.jsonl"), "-o", path("q.vdb")});
  EXPECT_EQ(twice["start_hash"], once["hash"]);
}

TEST_F(CliCommands, ExportsEveryFormatPrintable) {
  sculpt();
  for (const char* name : {"m.3mf", "m.stl", "m.obj", "m.ply"}) {
    const json report = run_ok({"export", path("p.vdb"), "-o", path(name)});
    expect_keys(report, {"triangles", "max_error_mm", "rms_error_mm", "volume_change"});
    expect_keys(report, kCheckKeys);
    EXPECT_TRUE(report.value("printable", false)) << name;
    const json check = run_ok({"check", path(name)});
    expect_keys(check, kCheckKeys);
    EXPECT_EQ(check["triangles"], report["triangles"]) << name;
    EXPECT_TRUE(check.value("printable", false)) << name;
  }
}

TEST_F(CliCommands, ExportsTheFieldForOtherPrograms) {
  sculpt();
  const json report =
      run_ok({"export", path("p.vdb"), "-o", path("field.vdb"), "--report", path("r.json")});
  expect_keys(report, {"voxel_mm", "active_voxels", "leaves", "bytes", "file_bytes", "clay_hash"});
  EXPECT_GT(report["active_voxels"], 1000);
  EXPECT_EQ(report["clay_hash"], run_ok({"info", path("p.vdb")})["hash"]);
  EXPECT_EQ(json::parse(content_of(path("r.json"))), report);
  const Ended over = run_argil({"export", path("p.vdb"), "-o", path("p.vdb")});
  EXPECT_EQ(over.status, 3);
  EXPECT_THAT(over.err, HasSubstr("give another name"));
  EXPECT_EQ(run_argil({"info", path("p.vdb")}).status, 0) << "the project is as it was";
}

TEST_F(CliCommands, ExportsEachBodyAsAPart) {
  make_ball_project(effort(10, 20));
  run_ok({"edit", path("p.vdb"), "-o", path("h.vdb"), "--hollow", "2"});
  const json report = run_ok({"export", path("h.vdb"), "-o", path("m.3mf"), "--parts"});
  EXPECT_EQ(report["parts"], 1) << "a cavity goes with its body";
  EXPECT_EQ(report["components"], 2);
}

TEST_F(CliCommands, ChecksTheWallsOfAProject) {
  make_ball_project(effort(10, 20));
  run_ok({"edit", path("p.vdb"), "-o", path("h.vdb"), "--hollow", "2"});
  const json good = run_ok({"check", path("h.vdb"), "--min-wall-mm", "1.8"});
  expect_keys(good, kCheckKeys);
  EXPECT_NEAR(good["min_wall_mm"], 2.0, 0.1);
  EXPECT_EQ(good["cavities"], 1);
  EXPECT_TRUE(good["file_bytes"].is_null());
  const Ended thin = run_argil({"check", path("h.vdb"), "--min-wall-mm", "2.2", "--json"});
  EXPECT_EQ(thin.status, 1);
  EXPECT_EQ(thin.json()["problems"][0]["kind"], "thin_wall");
}

TEST_F(CliCommands, WritesTheExportReport) {
  sculpt();
  const json said =
      run_ok({"export", path("p.vdb"), "-o", path("m.stl"), "--report", path("r.json")});
  EXPECT_EQ(json::parse(content_of(path("r.json"))), said);
}

TEST_F(CliCommands, CheckNamesPlacesAndGivesStatusOne) {
  fill(path("open.obj"), obj_text(without(box_mesh({10.0, 10.0, 10.0}), 0)));
  const Ended run = run_argil({"check", path("open.obj"), "--json"});
  EXPECT_EQ(run.status, 1);
  const json verdict = run.json();
  EXPECT_FALSE(verdict["printable"]);
  EXPECT_EQ(verdict["boundary_edges"], 3);
  ASSERT_FALSE(verdict["problems"].empty());
  expect_keys(verdict["problems"][0], {"kind", "at_mm", "size_mm"});
}

TEST_F(CliCommands, CheckJudgesForAPrinterAndShowsWhere) {
  fill(path("two.obj"), obj_text(test::joined(box_mesh({10.0, 10.0, 10.0}),
                                              box_mesh({4.0, 4.0, 4.0}, {0.0, 0.0, 20.0}))));
  fill(path("p.json"), R"({"argil_printer":1,"name":"small","bed_mm":[9,20,99],)"
                       R"("max_overhang_deg":45})");
  const Ended run = run_argil({"check", path("two.obj"), "--printer", path("p.json"), "--picture",
                               path("where.png"), "--ply", path("where.ply"), "--json"});
  EXPECT_EQ(run.status, 1) << run.err;
  const json verdict = run.json();
  EXPECT_EQ(verdict["printer"], "small");
  EXPECT_EQ(verdict["overhang_mm2"], 16.0);
  EXPECT_EQ(verdict["problems"][0]["kind"], "too_large");
  EXPECT_EQ(content_of(path("where.png")).substr(1, 3), "PNG");
  EXPECT_THAT(content_of(path("where.ply")), HasSubstr("property uchar red"));
  // What is given beside the profile counts.
  const json steep = run_ok({"check", path("two.obj"), "--overhang-deg", "89"});
  EXPECT_EQ(steep["overhang_mm2"], 16.0);
  EXPECT_EQ(steep["printer"], nullptr);
}

TEST_F(CliCommands, RendersProjectsAndMeshes) {
  sculpt();
  fill(path("box.obj"), obj_text(box_mesh({10.0, 20.0, 30.0})));
  for (const char* input : {"p.vdb", "box.obj"}) {
    for (const char* view : {"iso", "front", "top", "bottom", "1,-2,0.5"}) {
      const json report =
          run_ok({"render", path(input), "-o", path("pic.png"), "--size", "64x48", "--view", view});
      expect_keys(report, {"seconds"});
      const std::string png = content_of(path("pic.png"));
      ASSERT_GT(png.size(), 24U);
      EXPECT_EQ(png.substr(1, 3), "PNG");
      EXPECT_EQ(png[19], 64);  // width and height of the header, lowest bytes
      EXPECT_EQ(png[23], 48);
    }
  }
}

TEST_F(CliCommands, FeelsABallAlike) {
  make_ball_project();
  const auto force = [&](const std::string& method) {
    return run_ok({"force", path("p.vdb"), "--tool", "ball:2", "--at", "0,0,20", "--method", method,
                   "--repeat", "5"});
  };
  const json fine = force("fine");
  expect_keys(fine, {"force_n", "torque_nmm", "level", "voxel_mm", "samples", "cpu_us"});
  expect_keys(fine["cpu_us"], {"p50", "p99", "max"});
  EXPECT_EQ(fine["level"], 0);
  const double pushed = fine["force_n"][2];
  EXPECT_GT(pushed, 1.0);  // outward, along z only
  EXPECT_NEAR(fine["force_n"][0].get<double>(), 0.0, 0.01 * pushed);
  EXPECT_NEAR(fine["force_n"][1].get<double>(), 0.0, 0.01 * pushed);
  EXPECT_NEAR(force("lod")["force_n"][2].get<double>(), pushed, 0.02 * pushed);
  EXPECT_NEAR(force("point")["force_n"][2].get<double>(), pushed, 0.2 * pushed);
}

/// The dabs that windows are timed after are no one's work: they stay out of the project.
TEST_F(CliCommands, ForceTellsWhatWindowsTakeAndLeavesTheClay) {
  make_ball_project();
  const std::string before = text_of(path("p.vdb"));
  const auto force = [&](const std::vector<std::string>& more) {
    std::vector<std::string> arguments{"force", path("p.vdb"), "--at", "0,0,20"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run_ok(arguments);
  };
  const json times = force({"--tool", "ball:2", "--repeat", "4"})["window_ms"];
  EXPECT_EQ(times.size(), 3U);
  for (const char* kind : {"fresh", "moved", "after_dab"}) {
    const json& spread = times[kind];
    EXPECT_GT(spread["p50"].get<double>(), 0.0) << kind;
    EXPECT_GE(spread["p99"], spread["p50"]) << kind;
    EXPECT_GE(spread["max"], spread["p99"]) << kind;
  }
  EXPECT_EQ(text_of(path("p.vdb")), before);
  EXPECT_FALSE(force({"--tool", "ball:2"}).contains("window_ms"));
  // A fiftieth of a voxel: felt, but too small to work with.
  const json needle = force({"--tool", "ball:0.005", "--repeat", "2"})["window_ms"];
  EXPECT_TRUE(needle["after_dab"].is_null());
  EXPECT_GT(needle["fresh"]["p50"].get<double>(), 0.0);
}

/// What a scene needs: a needle is felt at its centre, a fist is not, and the reason is given.
TEST_F(CliCommands, ForceExplainsItsChoice) {
  make_ball_project();
  const auto explained = [&](const std::string& tool) {
    return run_ok({"force", path("p.vdb"), "--tool", tool, "--at", "0,0,20", "--explain"});
  };
  const json needle = explained("ball:0.5");
  EXPECT_EQ(needle["method"], "point");
  EXPECT_THAT(needle["why"].get<std::string>(), HasSubstr("within 1 % of the integral"));
  const json fist = explained("ball:6");
  EXPECT_EQ(fist["method"], "lod");
  EXPECT_THAT(fist["why"].get<std::string>(), HasSubstr("8 samples across"));
  EXPECT_LE(fist["error_n"].get<double>(), 0.05 * fist["force_n"][2].get<double>());
}

TEST_F(CliCommands, ForceTakesEveryShape) {
  make_ball_project();
  for (const char* tool : {"ball:3", "ellipsoid:2,3,4", "box:2,2,3", "capsule:2,6"}) {
    const auto force = [&](const std::string& method) {
      return run_ok({"force", path("p.vdb"), "--tool", tool, "--at", "1,2,20", "--method",
                     method})["force_n"][2]
          .get<double>();
    };
    const double fine = force("fine");
    EXPECT_GT(fine, 1.0) << tool;
    EXPECT_NEAR(force("lod"), fine, 0.01 * fine) << tool;
  }
}

TEST_F(CliCommands, StaysQuietWhenAsked) {
  sculpt();
  const Ended run = run_argil({"info", path("p.vdb"), "--quiet"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.out, "");
  EXPECT_EQ(run.err, "");
}

TEST_F(CliCommands, DrawsNoBarWhereThereIsNoTerminal) {
  fill(path("ball.obj"), obj_text(ball_mesh(10.0, 3)));
  const Ended run =
      run_argil({"import", path("ball.obj"), "-o", path("b.vdb"), "--voxel-mm", "0.5"});
  EXPECT_EQ(run.status, 0);
  EXPECT_EQ(run.err, "");
}

// ---- what a failure leaves behind --------------------------------------------------------------

TEST_F(CliCommands, LeaveTheOldFileWholeOnAFullDisk) {
  sculpt();
  fill(path("box.obj"), obj_text(box_mesh({10.0, 20.0, 30.0})));
  const std::vector<std::vector<std::string>> writers{
      {"sculpt", "--strokes", path("s.strokes.jsonl"), "-o", path("old.vdb")},
      {"import", path("box.obj"), "-o", path("old.vdb"), "--voxel-mm", "0.5"},
      {"export", path("p.vdb"), "-o", path("old.stl")},
      {"render", path("box.obj"), "-o", path("old.png"), "--size", "320x240"}};
  for (const std::vector<std::string>& arguments : writers) {
    fill(path("old.vdb"), "old");
    fill(path("old.stl"), "old");
    fill(path("old.png"), "old");
    const auto before = folder_.names().size();
    RunOptions full_disk;
    full_disk.largest_file_bytes = 4096;
    const Ended run = run_argil(arguments, full_disk);
    EXPECT_EQ(run.status, 5) << arguments[0] << ": " << run.err;
    EXPECT_THAT(run.err, HasSubstr("cannot write '")) << arguments[0];
    for (const char* name : {"old.vdb", "old.stl", "old.png"}) {
      EXPECT_EQ(content_of(path(name)), "old") << arguments[0];
    }
    EXPECT_EQ(folder_.names().size(), before) << arguments[0] << " left a temporary file";
  }
}

/// In a library that asks nobody too; by SIGTERM with its own status.
TEST_F(CliCommands, EndWhenTheyAreTold) {
  fill(path("ball.obj"), obj_text(ball_mesh(40.0, 6)));
  for (const int signal : {SIGINT, SIGTERM}) {
    RunOptions told;
    told.signal = signal;
    int asked = 0;
    // Two seconds on: a busy machine takes one to start it.
    told.interrupt_when = [&] { return ++asked > 2000; };
    const Ended run = run_argil(
        {"import", path("ball.obj"), "-o", path("o.vdb"), "--voxel-mm", "0.1", "--json"}, told);
    EXPECT_EQ(run.status, 128 + signal) << run.err;
    EXPECT_EQ(run.json()["error"]["kind"], "interrupted");
    EXPECT_FALSE(std::filesystem::exists(path("o.vdb")));
  }
}

/// By itself, and not because its time was over: then it says that no file is half written.
TEST_F(CliCommands, RenderHearsThatItIsToEnd) {
  fill(path("ball.obj"), obj_text(ball_mesh(40.0, 5)));
  fill(path("old.png"), "old");
  RunOptions told;
  int asked = 0;
  told.interrupt_when = [&] { return ++asked > 2000; };
  const Ended run = run_argil({"render", path("ball.obj"), "-o", path("old.png"), "--size",
                               "3200x2400", "--samples", "8", "--json"},
                              told);
  EXPECT_EQ(run.status, 128 + SIGINT) << run.err;
  EXPECT_EQ(run.json()["error"]["message"], "interrupted; no picture was made");
  EXPECT_EQ(content_of(path("old.png")), "old");
  EXPECT_EQ(folder_.names().size(), 2U) << "a temporary file was left";
}

TEST_F(CliCommands, LeaveTheOldFileWholeWhenInterrupted) {
  sculpt();
  for (const int delay_ms : {0, 5, 20, 60, 120}) {
    fill(path("old.vdb"), "old");
    const auto before = folder_.names().size();
    RunOptions interrupt;
    interrupt.interrupt_after_ms = delay_ms;
    const Ended run = run_argil(
        {"sculpt", "--strokes", path("s.strokes.jsonl"), "-o", path("old.vdb")}, interrupt);
    EXPECT_EQ(folder_.names().size(), before) << "a temporary file was left";
    if (run.status == 0) {  // done before the signal came
      EXPECT_EQ(run_argil({"info", path("old.vdb")}).status, 0);
      continue;
    }
    EXPECT_TRUE(run.status == 130 || run.signal != 0) << run.status << run.err;
    EXPECT_EQ(content_of(path("old.vdb")), "old");
  }
}

}  // namespace
}  // namespace argil::test
