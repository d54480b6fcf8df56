// SPDX-License-Identifier: Apache-2.0

#include "pipeline/shot/shot_reader.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "src/constants.h"
#include "tests/pipeline/expect_failure.h"
#include "tests/pipeline/shot/example_shot.h"
#include "tests/pipeline/temporary_folder.h"

namespace lensplane {
namespace {

using testing::HasSubstr;

/// The line that refuses the example in which `from` is replaced by `to`.
std::string line_for(const std::string& from, const std::string& to) {
  std::string text = kExampleShot;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  text.replace(at, from.size(), to);
  const Refusal refusal = refusal_of([&] { shot_from_yaml(parse_yaml(text, "s.yaml")); });
  EXPECT_EQ(refusal.line.find('\n'), std::string::npos);
  if (!refusal.line.empty()) {
    EXPECT_EQ(refusal.code, ExitCode::BadShot);
  }
  return refusal.line;
}

std::string line_for_setting(const std::string& setting) {
  return refusal_of([&] { example_shot({setting}); }).line;
}

TEST(ShotReader, ReadsTheExample) {
  const Shot shot = example_shot();
  EXPECT_EQ(shot.name, "example");
  EXPECT_EQ(shot.frames.size(), 3U);
  EXPECT_EQ(shot.camera.width, 40);
  EXPECT_EQ(shot.camera.height, 20);
  EXPECT_DOUBLE_EQ(value_at(std::get<Keyed<double>>(shot.camera.fov), 0), 3 * kPi / 180);
  ASSERT_EQ(shot.lenses.size(), 1U);
  EXPECT_NEAR(value_at(shot.lenses[0].m, 0), 14770.63277528, 1e-8);
  ASSERT_EQ(shot.layers.size(), 2U);
  EXPECT_EQ(value_at(std::get<SphereLayer>(shot.layers[0].kind).radius, 0), 6.371e6);
  EXPECT_EQ(shot.trace.method, Method::ShinotsukaMakino);
  EXPECT_FALSE(shot.output.data.any());
  EXPECT_EQ(shot.output.maps, (std::vector<bool>{true, true}));
  EXPECT_EQ(shot.colour.working.text, "ACEScg");
}

TEST(ShotReader, ReadsTheGlowOfTheCamera) {
  EXPECT_FALSE(example_shot().camera.glow);
  const Shot shot = example_shot({"camera.glow={strength: {keys: {1: 0, 3: 0.2}}, radius: 2 %}"});
  ASSERT_TRUE(shot.camera.glow);
  EXPECT_DOUBLE_EQ(value_at(shot.camera.glow->strength, 2), 0.1);
  EXPECT_DOUBLE_EQ(value_at(shot.camera.glow->radius, 2), 0.02);
  EXPECT_THAT(line_for_setting("camera.glow={strength: 1.5, radius: 2 %}"),
              HasSubstr("camera.glow.strength: \"1.5\"; allowed: from 0 to 1"));
  EXPECT_THAT(line_for_setting("camera.glow={strength: 0.1, radius: 101 %}"),
              HasSubstr("camera.glow.radius: \"101 %\"; allowed: more than 0 % and up to 100 %"));
  EXPECT_THAT(line_for_setting("camera.glow={strength: 0.1, radius: 2}"),
              HasSubstr("\"2\" has no unit; a share is needed, in %"));
  EXPECT_THAT(line_for_setting("camera.glow={strength: 0.1}"), HasSubstr("radius"));
  EXPECT_THAT(line_for_setting("camera.glow={strength: 0.1, radius: 1 %, colour: red}"), HasSubstr("colour"));
}

TEST(ShotReader, ReadsTheGrade) {
  EXPECT_FALSE(example_shot().colour.grade);
  const Shot shot = example_shot({"colour.grade={cdl: a.ccc, id: warm, space: ACEScct}"});
  ASSERT_TRUE(shot.colour.grade);
  EXPECT_EQ(shot.colour.grade->cdl.text, "a.ccc");
  EXPECT_EQ(shot.colour.grade->id, "warm");
  EXPECT_EQ(shot.colour.grade->space->text, "ACEScct");
  EXPECT_THAT(line_for_setting("colour.grade={cdl: look.cube}"),
              HasSubstr("colour.grade.cdl: \"look.cube\"; allowed: a .cc, .ccc or .cdl"));
  EXPECT_THAT(line_for_setting("colour.grade={id: warm}"), HasSubstr("colour.grade.cdl"));
}

TEST(ShotReader, ReadsWhatTheExampleLeavesOut) {
  const Shot shot = example_shot(
      {"fps=23.976", "camera.overscan=8", "output.maps=[background]",
       "output.image={type: float, compression: piz}", "output.review=none", "output.locator=beside",
       "layers.background.edge=mirror", "layers.earth.image={file: e.png, space: Raw, alpha: straight}",
       "camera.shutter={open: -0.25, close: 0.25, samples: 1}", "trace.law=auto", "trace.tolerance=0.05 px",
       "trace.effects={finite_distance: auto}", "layers.background.distance=infinity", "colour.view=Raw"});
  EXPECT_EQ(shot.fps.numerator, 24000);
  EXPECT_EQ(shot.fps.denominator, 1001);
  EXPECT_EQ(shot.camera.overscan, 8);
  EXPECT_EQ(shot.output.maps, (std::vector<bool>{false, true}));
  EXPECT_EQ(shot.output.image.type, PixelType::Float);
  EXPECT_EQ(shot.output.image.compression, ExrCompression::Piz);
  EXPECT_FALSE(shot.output.review);
  EXPECT_EQ(example_shot({"output.review=tiff16"}).output.review, ReviewFormat::Tiff16);
  EXPECT_EQ(shot.output.locator, Locator::Beside);
  EXPECT_EQ(std::get<PlateLayer>(shot.layers[1].kind).edge, Edge::Mirror);
  EXPECT_EQ(shot.layers[0].image.space->text, "Raw");
  EXPECT_EQ(shot.layers[0].image.alpha, AlphaKind::Straight);
  EXPECT_EQ(shot.colour.view.text, "Raw");
}

TEST(ShotReader, MapsMayChooseTheirCoverage) {
  EXPECT_EQ(example_shot().output.coverage, Coverage::Filtered);
  EXPECT_EQ(example_shot({"output.maps=[earth]"}).output.coverage, Coverage::Filtered);
  const Shot binary = example_shot({"output.maps={coverage: binary}"});
  EXPECT_EQ(binary.output.coverage, Coverage::Binary);
  EXPECT_EQ(binary.output.maps, (std::vector<bool>{true, true}));
  const Shot some = example_shot({"output.maps={layers: [background], coverage: filtered}"});
  EXPECT_EQ(some.output.coverage, Coverage::Filtered);
  EXPECT_EQ(some.output.maps, (std::vector<bool>{false, true}));
  EXPECT_EQ(example_shot({"output.maps={layers: none}"}).output.maps, (std::vector<bool>{false, false}));
}

TEST(ShotReader, DataFilesHoldWhatIsAskedForWhereThereAreMaps) {
  const auto data = [](const std::vector<std::string>& settings) {
    std::string names;
    const Shot shot = example_shot(settings);
    for (const EffectName& entry : kEffectNames) {
      if (shot.output.data.*entry.effect) names += std::string(entry.name) + " ";
    }
    return names;
  };
  EXPECT_EQ(data({"output.data=[depth, jacobian, depth]"}), "jacobian depth ");
  EXPECT_EQ(data({"output.data=all"}), "jacobian magnification delay direction shadow bends depth ");
  EXPECT_EQ(data({"output.data=none"}), "");
  EXPECT_EQ(data({"output.data=[]"}), "");
  EXPECT_EQ(data({"output.data=[bends]", "output.maps=[earth]"}), "bends ");
  EXPECT_EQ(data({"output.data=all", "output.maps=none"}), "");
  EXPECT_EQ(line_for_setting("output.data=[delay, colour]"),
            "--set output.data:1:9: output.data.1: \"colour\"; allowed: jacobian, magnification, delay, "
            "direction, shadow, bends, depth");
}

TEST(ShotReader, FrameRatesAreRatios) {
  const auto fps = [](const std::string& text) { return example_shot({"fps=" + text}).fps; };
  EXPECT_EQ(fps("24000/1001").numerator, 24000);
  EXPECT_EQ(fps("29.97").denominator, 1001);
  EXPECT_EQ(fps("12.5").numerator, 25);
  EXPECT_EQ(fps("12.5").denominator, 2);
  for (const char* wrong : {"0", "-24", "24/0", "1/2/3", "1/1001", "1/99999999999", "fast", "nan", "1e9"}) {
    EXPECT_THAT(line_for_setting(std::string("fps=") + wrong), HasSubstr("--set fps:1:1: fps: ")) << wrong;
  }
}

TEST(ShotReader, ReadsEveryProjection) {
  const auto fov = [](const Shot& shot) { return value_at(std::get<Keyed<double>>(shot.camera.fov), 0); };
  EXPECT_EQ(example_shot().camera.projection, Projection::Perspective);
  EXPECT_EQ(example_shot({"camera.projection=perspective"}).camera.projection, Projection::Perspective);
  const Shot fisheye = example_shot({"camera.projection=fisheye", "camera.fov=180 deg"});
  EXPECT_EQ(fisheye.camera.projection, Projection::Fisheye);
  EXPECT_DOUBLE_EQ(fov(fisheye), kPi);
  for (const char* whole : {"360 deg", "21600 arcmin", "6.283185307179587 rad"}) {
    const Shot shot = example_shot({"camera.projection=fisheye", std::string("camera.fov=") + whole});
    EXPECT_DOUBLE_EQ(fov(shot), 2 * kPi);
    EXPECT_LE(fov(shot), 2 * kPi) << whole;
  }
  const Shot latlong = example_shot({"camera.projection=latlong", "camera.fov=null"});
  EXPECT_EQ(latlong.camera.projection, Projection::LatLong);
}

TEST(ShotReader, FieldsOfViewFitTheirProjection) {
  const std::string latlong = "projection: latlong\n  ", fisheye = "projection: fisheye\n  ";
  EXPECT_EQ(line_for("fov: 3 deg", "fov: 180 deg"),
            "s.yaml:7:8: camera.fov: \"180 deg\"; allowed for a perspective camera: more than 0 deg and less "
            "than 180 deg");
  EXPECT_EQ(
      line_for("fov: 3 deg", fisheye + "fov: 361 deg"),
      "s.yaml:8:8: camera.fov: \"361 deg\"; allowed for a fisheye camera: more than 0 deg and up to 360 "
      "deg");
  EXPECT_EQ(
      line_for("fov: 3 deg", fisheye + "fov: {keys: {1001: 200 deg, 1002: 360.001 deg}}"),
      "s.yaml:8:37: camera.fov.keys.1002: \"360.001 deg\"; allowed for a fisheye camera: more than 0 deg "
      "and up to 360 deg");
  EXPECT_EQ(line_for("fov: 3 deg", "projection: fisheye"),
            "s.yaml:6:3: camera.fov: missing; needed: the full angle across the circle, like 180 deg");
  EXPECT_EQ(line_for("fov: 3 deg", fisheye + "focal_length: 8 mm"),
            "s.yaml:8:17: camera.focal_length: given for a fisheye camera; allowed: with perspective only, "
            "write fov");
  EXPECT_EQ(line_for("fov: 3 deg", fisheye + "fov: 90 deg\n  film_width: 36 mm"),
            "s.yaml:9:15: camera.film_width: given for a fisheye camera; allowed: with perspective only, "
            "write fov");
  EXPECT_EQ(line_for("fov: 3 deg", latlong + "fov: 360 deg"),
            "s.yaml:8:8: camera.fov: given for a latlong camera, which sees the whole sphere; allowed: with "
            "perspective and fisheye only");
  EXPECT_EQ(line_for("fov: 3 deg", latlong + "focal_length: 8 mm"),
            "s.yaml:8:17: camera.focal_length: given for a latlong camera, which sees the whole sphere; "
            "allowed: with perspective only");
  EXPECT_EQ(line_for("fov: 3 deg", latlong + "film_width: 36 mm"),
            "s.yaml:8:15: camera.film_width: given for a latlong camera, which sees the whole sphere; "
            "allowed: with perspective only");
  EXPECT_EQ(line_for("fov: 3 deg", "projection: latlong"), "");
}

TEST(ShotReader, KeysOfEveryKindAreRead) {
  const Shot shot =
      example_shot({"lenses.near.position={keys: {1001: [-8000 km, 0 km, -4e8 m], 1003: [8000 km, 0 km, -4e8 "
                    "m]}, interpolate: smooth}",
                    "lenses.near.mass={keys: {1001: 0 kg, 1003: 2 kg}}",
                    "camera.fov={keys: {1001: 1 deg, 1002: 3 deg}, interpolate: step}",
                    "layers.earth.light={keys: {1001: [1, 0, 0], 1003: [0, 0, 2]}}",
                    "trace.tolerance={keys: {1001: 0.1 px, 1003: 0.05 px}}",
                    "camera.shutter={open: {keys: {1001: -0.5, 1003: 0}}, close: 0.25}"});
  EXPECT_EQ(value_at(shot.lenses[0].position, 1002), Vec3(0, 0, -4e8));
  EXPECT_EQ(value_at(*std::get<SphereLayer>(shot.layers[0].kind).light, 1003), Vec3(0, 0, 1));
}

TEST(ShotReader, RefusesWithPlaceKeyReasonAndWhatIsAllowed) {
  EXPECT_EQ(
      line_for("fov: 3 deg", "fov: 3 m"),
      "s.yaml:7:8: camera.fov: \"3 m\" is a length; an angle is needed, in deg, rad, arcmin, arcsec, mas");
  EXPECT_EQ(
      line_for("fov: 3 deg", "fv: 3 deg"),
      "s.yaml:7:3: camera.fv: unknown key; allowed: projection, resolution, fov, focal_length, film_width, "
      "position, look_at, rotation, up, overscan, shutter, from, glow, exposure");
  EXPECT_EQ(
      line_for("  fov: 3 deg\n", ""),
      "s.yaml:6:3: camera.fov: missing; needed: the full horizontal angle, like 3 deg (or focal_length and "
      "film_width)");
  EXPECT_EQ(line_for("fov: 3 deg", "fov: 3 deg\n  fov: 4 deg"),
            "s.yaml:8:3: fov: this key stands here twice");
  EXPECT_EQ(line_for("mass: 1.989e31 kg", "mass: -1 kg"),
            "s.yaml:10:11: lenses.near.mass: \"-1 kg\" is negative; allowed: 0 or more");
  EXPECT_EQ(line_for("mass: 1.989e31 kg", "mass: nan kg"),
            "s.yaml:10:11: lenses.near.mass: \"nan kg\" is not finite; a mass is needed, in g, kg, Msun, "
            "Mearth, Mjup");
  EXPECT_EQ(line_for("[40, 20]", "[0, 20]"),
            "s.yaml:6:16: camera.resolution.0: \"0\"; allowed: a whole number from 1 to 65536");
  EXPECT_EQ(line_for("1001-1003", "1003-1001"),
            "s.yaml:3:9: frames: \"1003-1001\" ends before it starts; write 1001-1003");
  EXPECT_EQ(line_for("type: plate", "type: plane"),
            "s.yaml:19:11: layers.background.type: \"plane\"; allowed: plate, latlong, sphere, ring, stars, "
            "povray");
  EXPECT_EQ(line_for("lensplane: 1", "lensplane: 2"),
            "s.yaml:1:12: lensplane: \"2\" is a version this program does not read; allowed: 1");
  EXPECT_EQ(
      line_for("shot: example", "shot: a/b"),
      "s.yaml:2:7: shot: \"a/b\" cannot be part of a file name; allowed: up to 100 letters, digits, _ and -");
  EXPECT_EQ(line_for("name: background", "name: near"),
            "s.yaml:18:11: layers.near.name: \"near\" is already the name of a lens or layer");
  EXPECT_EQ(
      line_for("[0 m, 0 m, -4.36e8 m]", "[0 m, 0 m]"),
      "s.yaml:11:15: lenses.near.position: needed: a list of three, [x, y, z], each a length, like 1 mm");
}

TEST(ShotReader, RefusesEveryOtherMistake) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"camera.fov=0 deg", "not greater than 0"},
      {"camera.fov=180 deg", "less than 180 deg"},
      {"camera.fov=1e-14 deg", "narrower than any picture"},
      {"camera.resolution=[65536, 65536]", "more than 256 million pixels"},
      {"camera.fov={keys: {1001: 3 deg, 1002: 181 deg}}", "camera.fov.keys.1002"},
      {"camera.fov={keys: {}}", "no keys"},
      {"camera.fov={keys: {1001: 3 deg}, interpolate: cubic}", "allowed: linear, smooth, step"},
      {"camera.fov={keys: {1002: 3 deg, 1001: 2 deg}}", "does not come after frame 1002"},
      {"camera.fov={keys: {soon: 3 deg}}", "not a number"},
      {"camera.fov=[1, 2]", "a list where an angle is needed"},
      {"camera.focal_length=35 mm", "given together with fov"},
      {"camera.film_width=36 mm", "with focal_length only"},
      {"camera.overscan=3", "even number"},
      {"camera.overscan=-2", "whole number from 0"},
      {"camera.resolution=[40.5, 20]", "whole number"},
      {"camera.resolution=40", "[width, height]"},
      {"camera.rotation=[1, 2, 3]", "has no unit"},
      {"camera.look_at=moon", "no lens or layer"},
      {"camera.look_at=background", "has no centre to look at"},
      {"camera.up=[0, 1, 0]", "only together with look_at"},
      {"camera.shutter={open: 1, close: 0}", "closes before it opens"},
      {"camera.shutter.samples=0", "whole number from 1"},
      {"camera.exposure=33", "allowed: from -32 to 32 stops"},
      {"layers.earth.exposure=1 px", "a plain number is needed"},
      {"output={review: {type: png}}", "output.review.type: unknown key; allowed: format, exposure"},
      {"camera.shutter={angle: 180 deg, close: 1}", "camera.shutter.close: given together with angle"},
      {"camera.shutter={angle: 361 deg}", "more than 0 deg and up to 360 deg"},
      {"camera.shutter={angle: 0 deg}", "not greater than 0"},
      {"camera.projection=round", "allowed: perspective, latlong, fisheye"},
      {"camera=3", "a map is needed"},
      {"lenses=3", "a list is needed"},
      {"lenses.near=3", "a map with the key name"},
      {"lenses.near.radius=3 km", "given together with mass"},
      {"lenses.near.name=near!", "cannot be part of a file name"},
      {"lenses.near.colour=red", "unknown key"},
      {"layers=[]", "at least one layer"},
      {"layers.earth.radius=0 m", "not greater than 0"},
      {"layers.earth.radius=-1 m", "not greater than 0"},
      {"layers.earth.light=[0, 0, 0]", "points nowhere"},
      {"layers.earth.edge=black", "unknown key"},
      {"layers.earth.image={space: Raw}", "layers.earth.image.file: missing"},
      {"layers.earth.image={file: a.png, alpha: maybe}", "allowed: associated, straight, none"},
      {"layers.earth.night=night.jpg", "without light there is no night"},
      {"layers.earth.night={file: n.png, gamma: 2}", "without light there is no night"},
      {"layers.background.edge=hard", "allowed: black, clamp, mirror, repeat"},
      {"layers.background.distance=-3 m", "not greater than 0"},
      {"trace.method=newton", "allowed: kishi, shinotsuka-makino, planes, geodesic"},
      {"trace.law=strong", "allowed: weak, second-order, exact, auto"},
      {"trace.tolerance=0 px", "not greater than 0"},
      {"trace.tolerance=0.1 deg", "a number of pixels is needed"},
      {"trace.effects={gravity: on}", "unknown key"},
      {"trace.effects={finite_distance: maybe}", "allowed: on, off, auto"},
      {"sampling={rays: 4}", "sampling.rays: unknown key; allowed: max, threshold"},
      {"sampling.max=0", "whole number from 1 to 64"},
      {"sampling.max=128", "whole number from 1 to 64"},
      {"sampling.max=32", "\"32\"; allowed: 1, 4, 16, 64"},
      {"sampling.threshold=0", "not greater than 0"},
      {"sampling.threshold=1.5", "more than 0 and up to 1"},
      {"camera.shutter.samples=257", "whole number from 1 to 256"},
      {"output.maps=some", "allowed: all, none"},
      {"output.maps={coverage: soft}", "output.maps.coverage: \"soft\"; allowed: filtered, binary"},
      {"output.maps={coverage: filtered, edge: 2}",
       "output.maps.edge: unknown key; allowed: layers, coverage"},
      {"output.maps={layers: [mars]}", "allowed: earth, background"},
      {"output.maps=[mars]", "allowed: earth, background"},
      {"output.data=[colour]", "allowed: jacobian, magnification, delay, direction, shadow, bends, depth"},
      {"output.data=some", "allowed: all, none"},
      {"output.image={type: double}", "allowed: half, float"},
      {"output.image={compression: zap}", "allowed: none, rle"},
      {"output.review=jpeg", "allowed: none, png, png16, tiff16"},
      {"output.movie=gif", "allowed: none, mp4, prores"},
      {"output.locator=left", "allowed: none, beside"},
      {"colour={gamma: 2}", "unknown key"},
      {"frames=1001-1003x0", "steps by 0"},
      {"grade={}", "unknown key"},
  };
  for (const auto& [setting, reason] : mistakes) {
    const Refusal refusal = refusal_of([&] { example_shot({setting}); });
    EXPECT_THAT(refusal.line, HasSubstr(reason)) << setting;
    EXPECT_EQ(refusal.code, ExitCode::BadShot) << setting;
    EXPECT_EQ(refusal.line.find('\n'), std::string::npos) << setting;
  }
}

TEST(ShotReader, SaysWhatIsNotAvailableYet) {
  const std::pair<const char*, const char*> later[] = {
      {"output.movie=mp4", "output.movie: not available yet: mp4"},
  };
  for (const auto& [setting, expected] : later) {
    const Refusal refusal = refusal_of([&] { example_shot({setting}); });
    EXPECT_THAT(refusal.line, HasSubstr(expected)) << setting;
    EXPECT_EQ(refusal.code, ExitCode::BadShot);
  }
  EXPECT_THAT(line_for("trace:", "output:\n  movie: mp4\ntrace:"),
              HasSubstr("s.yaml:22:10: output.movie: not"));
}

TEST(ShotReader, ReadsWhatPovRayIsToDo) {
  const Shot shot =
      example_shot({"layers.background={name: p, type: povray, scene: a.pov, distance: 2e9 m, unit: 1 km, "
                    "edge: mirror, antialias: 4, timeout: 2 min}"});
  const Layer& layer = shot.layers[1];
  ASSERT_TRUE(layer.povray);
  EXPECT_EQ(layer.povray->as, PovRayAs::Plate);
  EXPECT_EQ(layer.povray->unit_m, 1000.0);
  EXPECT_EQ(layer.povray->antialias, 4);
  EXPECT_EQ(layer.povray->timeout_s, 120.0);
  const auto& plate = std::get<PlateLayer>(layer.kind);
  EXPECT_TRUE(plate.distance && !plate.bent);
  EXPECT_EQ(plate.edge, Edge::Mirror);
  const Shot bent = example_shot({"layers.background={name: p, type: povray, scene: a.pov, as: bent}"});
  EXPECT_TRUE(std::get<PlateLayer>(bent.layers[1].kind).bent);
  EXPECT_EQ(bent.layers[1].povray->antialias, PovRayScene::kBentAntialias);
  const Shot sky =
      example_shot({"layers.background={name: p, type: povray, scene: a.pov, as: latlong, width: 512}"});
  EXPECT_TRUE(std::holds_alternative<LatLongLayer>(sky.layers[1].kind));
  EXPECT_EQ(sky.layers[1].povray->width, 512);
}

TEST(ShotReader, RefusesWhatPovRayCannotDo) {
  const std::pair<const char*, const char*> mistakes[] = {
      {"scene: a.pov, as: card", "allowed: plate, latlong, bent"},
      {"as: plate", "scene: missing"},
      {"scene: a.pov, distance: -3 m", "not greater than 0"},
      {"scene: a.pov, as: bent, distance: 3 m", "has a meaning only with as: plate"},
      {"scene: a.pov, as: bent, edge: clamp", "has a meaning only with as: plate"},
      {"scene: a.pov, width: 512", "has a meaning only with as: latlong"},
      {"scene: a.pov, as: latlong, width: 511", "is odd"},
      {"scene: a.pov, antialias: 9", "a whole number from 1 to 8"},
      {"scene: a.pov, unit: 0 m", "not greater than 0"},
      {"scene: a.pov, timeout: 3", "a time is needed, in s, min, h"},
      {"scene: a.pov, image: b.exr", "unknown key"},
  };
  for (const auto& [keys, reason] : mistakes)
    EXPECT_THAT(line_for_setting(std::string("layers.background={name: p, type: povray, ") + keys + "}"),
                HasSubstr(reason));
}

TEST(ShotReader, WhatIsNotAvailableYetIsStillChecked) {
  // A mistake comes before what is not available.
  const Refusal refusal = refusal_of([&] { example_shot({"output.movie=mp4", "output.review=jpeg"}); });
  EXPECT_THAT(refusal.line, HasSubstr("allowed: none, png"));
}

TEST(ShotReader, ReadsSamplingShutterAndOpenOverscan) {
  const Shot usual = example_shot();
  EXPECT_EQ(usual.sampling.max, 64);
  EXPECT_EQ(usual.sampling.threshold, 0.004);
  EXPECT_EQ(usual.camera.shutter.samples, 1);
  EXPECT_EQ(usual.camera.overscan, 0);
  const Shot shot =
      example_shot({"sampling={max: 16, threshold: 0.01}", "camera.overscan=auto",
                    "camera.shutter={open: -0.5, close: {keys: {1001: 0, 1003: 0.5}}, samples: 256}"});
  EXPECT_EQ(shot.sampling.max, 16);
  EXPECT_EQ(shot.sampling.threshold, 0.01);
  EXPECT_EQ(shot.camera.overscan, std::nullopt);
  EXPECT_EQ(shot.camera.shutter.samples, 256);
  EXPECT_EQ(value_at(shot.camera.shutter.open, 1002), -0.5);
  EXPECT_EQ(value_at(shot.camera.shutter.close, 1002), 0.25);
}

TEST(ShotReader, ReadsExposures) {
  const Shot usual = example_shot({"output={review: png16}"});
  EXPECT_EQ(value_at(usual.camera.exposure, 1001), 0);
  EXPECT_EQ(value_at(usual.layers[0].exposure, 1001), 0);
  EXPECT_EQ(value_at(usual.output.review_exposure, 1001), 0);
  EXPECT_EQ(usual.output.review, ReviewFormat::Png16);
  const Shot shot =
      example_shot({"camera.exposure=1.5", "layers.earth.exposure={keys: {1001: -1, 1003: 1}}",
                    "layers.background.exposure=3", "output={review: {format: tiff16, exposure: -2}}"});
  EXPECT_EQ(value_at(shot.camera.exposure, 1001), 1.5);
  EXPECT_EQ(value_at(shot.layers[0].exposure, 1002), 0);
  EXPECT_EQ(value_at(shot.layers[0].exposure, 1003), 1);
  EXPECT_EQ(value_at(shot.layers[1].exposure, 1001), 3);
  EXPECT_EQ(value_at(shot.output.review_exposure, 1001), -2);
  EXPECT_EQ(shot.output.review, ReviewFormat::Tiff16);
  EXPECT_EQ(example_shot({"output={review: {exposure: 1}}"}).output.review, ReviewFormat::Png);
  for (const char* layer :
       {"{name: a, type: latlong, image: a.exr, exposure: 2}",
        "{name: a, type: ring, centre: [0 m, 0 m, 0 m], normal: [0, 1, 0], inner: 1 m, outer: 2 m, "
        "image: a.exr, exposure: 2}",
        "{name: a, type: povray, scene: a.pov, exposure: 2}"}) {
    EXPECT_EQ(value_at(example_shot({std::string("layers.background=") + layer}).layers[1].exposure, 1001), 2)
        << layer;
  }
}

TEST(ShotReader, AShutterThatIsGivenBlurs) {
  const auto shutter = [](const std::string& text) {
    return example_shot({"camera.shutter=" + text}).camera.shutter;
  };
  for (const char* text : {"{}", "{samples: auto}", "{angle: 180 deg}", "{open: -0.25, close: 0.25}"}) {
    EXPECT_EQ(shutter(text).samples, std::nullopt) << text;
    EXPECT_EQ(value_at(shutter(text).open, 1001), -0.25) << text;
    EXPECT_EQ(value_at(shutter(text).close, 1001), 0.25) << text;
  }
  const Shutter keyed = shutter("{angle: {keys: {1001: 90 deg, 1003: 360 deg}}, samples: 3}");
  EXPECT_EQ(keyed.samples, 3);
  EXPECT_NEAR(value_at(keyed.open, 1001), -0.125, 1e-15);
  EXPECT_NEAR(value_at(keyed.close, 1003), 0.5, 1e-15);
}

TEST(ShotReader, PathsAreRelativeToTheShotFile) {
  const TemporaryFolder folder;
  const auto path = folder.write("example.yaml", kExampleShot);
  const Shot shot =
      read_shot(path, {"output.directory=../out", "layers.earth.image=lensplane:textures/earth_day.jpg"});
  EXPECT_EQ(shot.output.directory, (folder.path().parent_path() / "out"));
  EXPECT_EQ(shot.layers[0].image.pattern.text, "lensplane:textures/earth_day.jpg");
  EXPECT_EQ(shot.layers[1].image.pattern.text, (folder / "bg.####.exr").string());
  EXPECT_EQ(read_shot(path).output.directory, folder / "renders/example");
  const Shot more = read_shot(path, {"layers.earth.light=[1, 0, 0]", "layers.earth.night=../night.jpg",
                                     "layers.background={name: s, type: stars, catalogue: stars.csv}"});
  EXPECT_EQ(std::get<SphereLayer>(more.layers[0].kind).night->pattern.text,
            (folder.path().parent_path() / "night.jpg").string());
  EXPECT_EQ(std::get<StarsLayer>(more.layers[1].kind).catalogue.text, (folder / "stars.csv").string());
}

}  // namespace
}  // namespace lensplane
