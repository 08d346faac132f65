// The page's modules that know no browser, and rules that all of its modules keep: node --test page_test.mjs
import assert from "node:assert/strict";
import fs from "node:fs";
import test from "node:test";

const folder = new URL("../../src/view/page/", import.meta.url);
const load = name => import(new URL(name + ".mjs", folder));
const camera = await load("camera"), looks = await load("looks"), numbers = await load("numbers");
const link = await load("link"), rates = await load("rates"), search = await load("search");
const {described} = await load("shapes");
const {Steps} = await load("undo");

/// Numbers between 0 and 1, the same in every run.
function random_numbers(seed) {
  let state = seed;
  return () => (state = (state * 48271) % 2147483647) / 2147483647;
}
const near = (a, b, most, what) => a.forEach((v, i) => assert.ok(Math.abs(v - b[i]) <= most, `${what}: ${a}, ${b}`));
const any_camera = random => ({azimuth: 360 * random(), elevation: 180 * random() - 90, view_size: 10 + 100 * random(),
  perspective: random() < 0.5 ? 0 : 5 + 80 * random(), center: [random(), random(), random()]});

test("a fitted box touches the picture's edges and crosses none, in windows of all shapes", () => {
  const random = random_numbers(7);
  for (let i = 0; i < 300; i++) {
    Object.assign(camera.size, {css_width: 100 + 900 * random(), css_height: 100 + 900 * random()});
    const low = [0, 0, 0].map(() => 200 * random() - 100), high = low.map(v => v + 1 + 300 * random());
    const made = camera.fitted(any_camera(random), {low, high}), {css_width, css_height} = camera.size;
    const ratio = camera.reach(made, {low, high});
    assert.ok(ratio <= 1 && ratio > 0.6, `the farthest corner is at ${ratio} of the way to an edge`);
    const before = {css_width, css_height};
    Object.assign(camera.size, {css_width: css_width * (0.3 + random()), css_height: css_height * (0.3 + random())});
    assert.ok(camera.reach(camera.kept_in_view(made, {low, high}, before), {low, high}) <= 1, "a panel opens");
  }
});
test("a turn keeps the pivot in its place, a zoom and a pan what is under the pointer", () => {
  const random = random_numbers(11);
  Object.assign(camera.size, {css_width: 640, css_height: 480});
  for (let i = 0; i < 300; i++) {
    const before = any_camera(random), x = 640 * random(), y = 480 * random(), z = before.view_size * (random() - 1);
    const point = camera.under(before, x, y, z), seen = made => camera.on_screen(made, point);
    near(seen(before), [x, y], 1e-6, "under");
    near(seen(camera.turned(before, 720 * random() - 360, 60, point)), [x, y], 1e-6, "turned");
    near(seen(camera.zoomed(before, 0.3 + random(), 1000, x, y, z)), [x, y], 1e-6, "zoomed");
    near(seen(camera.panned(before, 13, -7, z)), [x + 13, y - 7], 1e-6, "panned");
  }
});

test("sizes of quadrics, of superellipsoids and of tori with an ellipse, in any place", () => {
  const axis = [0, 3, 4], a = [0, -8, 6], base = [1, 2, 3], height = [0, 15, 20];
  for (const [name, shape, wanted] of [
    ["paraboloid", {type: "epa", base, height, a, r1: 6, r2: 6}, {"diameter at the base": 12, height: 25}],
    ["elliptical hyperboloid", {type: "ehy", base, height, a, r1: 6, r2: 4, c: 2},
      {"diameter 1 at the base": 12, "diameter 2 at the base": 8, height: 25}],
    ["hyperboloid of one sheet", {type: "hyp", base, height, a, b: 10, neck: 0.4},
      {"diameter at the ends": 20, "diameter at the waist": 8, height: 25}],
    ["elliptical hyperboloid of one sheet", {type: "hyp", base, height, a, b: 5, neck: 0.4},
      {"diameter 1 at the ends": 20, "diameter 2 at the ends": 10, "diameter 1 at the waist": 8,
       "diameter 2 at the waist": 4, height: 25}],
    ["superellipsoid", {type: "superell", center: base, a: [0, 3, 4], b: [7, 0, 0], c: [0, -4, 3], n: 0.5, e: 1},
      {"diameter 1": 10, "diameter 2": 14, "diameter 3": 10}],
    ["elliptical torus", {type: "eto", center: base, axis, radius: 20, c: a, d: 3},
      {"diameter of the ring's middle": 40, "diameter 1 of the tube": 20, "diameter 2 of the tube": 6, diameter: 60,
       height: 6}],
    ["elliptical torus", {type: "eto", center: base, axis, radius: 20, c: axis, d: 5},
      {"diameter of the ring's middle": 40, "diameter of the tube": 10, diameter: 50, height: 10}]]) {
    const form = described(shape);
    assert.equal(form.name, name);
    assert.deepEqual(form.sizes.map(({label}) => label), Object.keys(wanted));
    for (const {label, mm, ends: [from, to]} of form.sizes) {
      assert.ok(Math.abs(mm - wanted[label]) < 1e-12 * 60, `${name}, ${label}: ${mm}`);
      assert.ok(Math.abs(Math.hypot(...numbers.minus(to, from)) - mm) < 1e-12 * 60, `${name}, ${label}: the ends`);
    }
  }
  const ring = described({type: "eto", center: [0, 0, 0], axis: [0, 0, 2], radius: 20, c: [0, 3, 4], d: 2});
  const [, , , whole, height_of] = ring.sizes;  // the reach of an ellipse that stands aslant
  near([whole.mm, height_of.mm], [2 * (20 + Math.hypot(3, 1.6)), 2 * Math.hypot(4, 1.2)], 1e-12, "aslant");
});

const regions_of = paths => ({paths, own_looks: [{state: "shown", color: [1, 1, 1]}], look_of: paths.map(() => 0)});
test("parts are asked for as ranges of the model's list", () => {
  const table = looks.region_table({paths: ["/b/2", "/a", "/c", "/b/1", "/b/3"], look_of: [0, 1, 1, 0, 0],
    own_looks: [{state: "ghost", color: [1, 0, 0]}, {state: "hidden", color: [0, 1, 0]}]});
  assert.deepEqual([...table.ids], [1, 3, 0, 4, 2]);
  assert.deepEqual([...table.states], [2, 1, 1, 1, 2]);
  assert.deepEqual(table.colors.map(color => color[0]), [0, 1, 1, 1, 0]);
  const listed = (...paths) => looks.listed_ranges(table, paths.map(path => looks.range_of(table.paths, path)));
  assert.deepEqual(listed("/b"), [[0, 1], [3, 5]]);
  assert.deepEqual(listed("/b", "/b/3", "/a", "/gone"), [[0, 2], [3, 5]]);
  assert.deepEqual(listed("/", "/c"), [[0, 5]]);
  assert.deepEqual(listed(), []);
});
test("a path means all regions below it, and no path that only begins alike", () => {
  const {paths} = looks.region_table(regions_of(["/a/b", "/a.r", "/a/b.c", "/a/b/c", "/a!", "/ab"]));
  const below = path => paths.slice(...looks.range_of(paths, path)).sort();
  assert.deepEqual(below("/a"), ["/a/b", "/a/b.c", "/a/b/c"]);
  assert.deepEqual(below("/a/b.c"), ["/a/b.c"]);
  assert.deepEqual(below("/none"), []);
});
test("looks that are kept short mean the same as all of them in turn", () => {
  const random = random_numbers(3), one_of = list => list[Math.floor(random() * list.length)];
  const paths = ["/a/b/1", "/a/b/2", "/a/c/1", "/d/1", "/d/2"], places = [...paths, "/", "/a", "/a/b", "/a/c", "/d"];
  for (let run = 0; run < 100; run++) {
    const table = looks.region_table(regions_of(paths)), all = [];
    let short = [];
    for (let i = 0; i < 12; i++) {
      const [member, value] = random() < 0.7 ? ["state", one_of(looks.STATES)] : ["color", [random(), 0, 0]];
      const several = [one_of(places), ...random() < 0.3 ? [one_of(places)] : []];
      all.push(...several.map(path => ({path, [member]: value})));
      short = looks.with_looks(table, short, several, member, value);
      if (random() < 0.1) {
        all.push({path: "/", state: "hidden"});
        short = looks.with_state_of_all(table, short, "hidden");
      }
      const {states, colors} = table;
      for (const list of [all, short]) {
        looks.apply_looks(table, list);
        assert.deepEqual([table.states, table.colors], [states, colors]);
      }
    }
    assert.ok(short.length <= places.length);
    assert.deepEqual(looks.without_colors(short, "/a").filter(({path, color}) => color && /^.a|^.$/.test(path)), []);
  }
});

test("looks of 100,000 parts beside each other take linear time", () => {
  const paths = Array.from({length: 100000}, (_, i) => `/part${i}.r`), table = looks.region_table(regions_of(paths));
  const hidden = looks.with_state_of_all(table, [], "hidden");
  const alone = looks.with_looks(table, hidden, ["/part7.r"], "state", "shown");
  assert.equal(table.states.filter(state => state === 0).length, 1);
  assert.equal(alone.length, 2);
  assert.deepEqual(looks.with_state_of_all(table, alone, "shown"), []);
  assert.deepEqual(looks.with_looks(table, alone, paths, "state", "ghost"), [{path: "/", state: "ghost"}]);
  assert.deepEqual(looks.lost_paths(table, ["/part7.r", "/gone"]), ["/gone"]);
});

test("undo goes back and forth among the states; one drag is one step", () => {
  const steps = new Steps(), [a, b, c, d] = [[1], [2], [3], [4]];
  const note = (looks, moving, now) => steps.note({looks, clip: a}, moving, now);
  [[a, false, 0], [b, true, 100], [c, true, 200], [[c[0]], true, 300], [d, true, 2000]].forEach(one => note(...one));
  assert.deepEqual([-1, -1, -1].map(count => steps.go(count)?.looks), [c, a, undefined]);
  assert.equal(steps.can_undo, false);
  assert.deepEqual([1, 1, 1].map(count => steps.go(count)?.looks), [c, d, undefined]);
  steps.go(-1);
  note(b, false, 3000);
  assert.equal(steps.can_redo, false);
  assert.equal(steps.go(-1).looks, c);
});

test("a link gives what it was made of; what is wrong with others is said", () => {
  const usual = {camera: {azimuth: 1, elevation: 2, perspective: 0, center: [0, 0, 0], view_size: 9}, clip: [],
                 looks: [], show: "color", edges: true, light: "studio"};
  const view = {...usual, clip: [{normal: [1, 0, 0], distance: 2}], looks: [{path: "/a'%#", state: "ghost"}],
                edges: false, light: "model", ground: [[0, 0, 0], [1, 0.5, 1]], hatch: false, guides: true};
  const page = {slice: {plane: 0, place: [1, 2], mm: 0.5}, selected: ["/a"],
                answer: {camera: usual.camera, width: 9, height: 8, x: 3, y: 4, from: [1, 2, 3], to: [4, 5, 6]},
                measurements: [{what: "a", value: 1, unit: "mm", part: "/a", ends: [[1, 2, 3], [4, 5, 6]]}]};
  const read = text => link.read_link(text, usual, {show: ["color"], light: ["studio", "model"]});
  assert.deepEqual(read(link.written_link(view, page).slice(1)), {view, ...page});
  for (const [text, why] of [["%7Bbad", /cut short/], ["%E0%A4", /cut short/], ["[1]", /object/], ["null", /object/],
    ['{"looks":[null]}', /looks/], ['{"clip":[{}]}', /clip/], ['{"camera":{"view_size":0}}', /camera/],
    ['{"show":"all"}', /show/], ['{"light":"sun"}', /light/], ['{"edges":1}', /edges/], ['{"ground":[1]}', /ground/],
    ['{"slice":{"plane":0}}', /slice/], ['{"selected":[1]}', /selected/],
    ['{"answer":{"x":1}}', /answer/], ['{"measurements":[{"value":"1"}]}', /measurements/]])
    assert.throws(() => read(text), why, text);
});

test("the search gives the shortest path whose last leg ends the match", () => {
  const paths = ["/car/wheels/left", "/car/wheels/right", "/car/wheel.r", "/Wheel"];
  assert.deepEqual(search.found_in(paths, "wheel"),
                   [["/car/wheels", false, 5], ["/car/wheel.r", true, 5], ["/Wheel", true, 1]]
                     .map(([path, leaf, at]) => ({path, leaf, at})));
  assert.deepEqual(search.found_in(paths, "car/wheels/l"), [{path: "/car/wheels/left", leaf: true, at: 1}]);
});

test("a long name keeps its end, and the match is marked in both halves", () => {
  assert.deepEqual(search.name_pieces("short.r"), {head: [["short.r", false]], tail: []});
  const {head, tail} = search.name_pieces("bottom_plate_left_0123.r", 12, 20);
  assert.deepEqual(head, [["bottom_plate", false], ["_left_", true]]);
  assert.deepEqual(tail, [["01", true], ["23.r", false]]);
});

test("coarse frames become coarser when they are slow, and finer when a finer frame would be quick", () => {
  const pace = {divisor: 4, wall: 0, wall_of: 0};
  rates.adapt(pace, 4, 80);
  assert.equal(pace.divisor, 8);
  for (let i = 0; i < 9; i++) rates.adapt(pace, pace.divisor, 4 + 16 / pace.divisor ** 2);
  assert.equal(pace.divisor, 1);
  rates.adapt(pace, 1, 100);
  assert.equal(pace.divisor, 2);
});
test("pixels come compressed on a slow link, and raw again on a quick one", () => {
  const link = {rates: [], deflate: false}, full = {coarse: false, samples: 1};
  const encodings = () => [1, 8].map(number => rates.encoding_of(link, full, number));
  rates.note_rate(link, 1000, 1000);  // too small to tell
  assert.deepEqual(encodings(), ["raw", "raw"]);
  rates.note_rate(link, 56e3, 90);  // the first coarse picture by 5 Mbit/s
  assert.deepEqual(encodings(), ["deflate", "deflate"]);
  for (let i = 0; i < 3; i++) rates.note_rate(link, 2e5, 4);
  assert.deepEqual(encodings(), ["deflate", "raw"]);  // 50 MB/s or more
  rates.note_rate(link, 6e6, 10);
  assert.deepEqual(encodings(), ["raw", "raw"]);
});

const modules = new Map(fs.readdirSync(folder).filter(name => name.endsWith(".mjs"))
  .map(name => [name, fs.readFileSync(new URL(name, folder), "utf8")]));
const without_texts = text => text.replace(/\\./g, "").replace(/"[^"\n]*"/g, '""').replace(/\/\/.*/g, "");
test("every module imports the names that it uses, and no others", () => {
  const exported = new Map();
  for (const [name, text] of modules)
    for (const [, line] of text.matchAll(/^export (?:async )?(?:const|let|function|class) (.*)/gm))
      for (const [, found] of ` ${line.startsWith("{") ? "" : line}`.matchAll(/(?:^ |, )(\w+)(?= = |\(| \{)/g))
        exported.set(found, name);
  for (const [name, text] of modules) {
    const imported = [...text.matchAll(/^import \{([^}]*)\} from "\.\/([^"]*)";/gm)]
      .flatMap(([, names, from]) => names.split(/,\s*/).map(found => [found.trim(), from]));
    const body = without_texts(text.replace(/^import \{[^}]*\} from .*;/gm, ""));
    for (const [found, from] of imported) {
      assert.equal(exported.get(found), from, `${name} imports ${found} from ${from}`);
      assert.match(body, new RegExp(`\\b${found}\\b`), `${name} imports ${found} and does not use it`);
      assert.doesNotMatch(body, new RegExp(`^\\s*${found} =[^=]`, "m"), `${name} changes the imported ${found}`);
    }
    const known = new Set(imported.map(([found]) => found));
    const has_own = found => new RegExp(`\\b${found}(, \\w+)* =|[(,] ?${found}[,)]`).test(body);
    for (const [, found] of body.matchAll(/(?<![.\w"])(\w+)\(/g))
      assert.ok(!exported.has(found) || exported.get(found) === name || known.has(found) || has_own(found),
                `${name} calls ${found} and does not import it`);
  }
});
test("the page names every module, and no line has three statements", () => {
  const page = fs.readFileSync(new URL("index.html", folder), "utf8");
  const named = [...page.matchAll(/<script src="([^"]*)">/g)].map(([, name]) => name);
  assert.deepEqual(named.sort(), [...modules.keys()].sort());
  for (const [name, text] of modules)
    without_texts(text).replace(/for \([^)]*\)/g, "").split("\n").forEach((line, i) =>
      assert.ok(line.split(";").filter(part => /\w/.test(part)).length < 3, `${name}:${i + 1}: ${line}`));
});
