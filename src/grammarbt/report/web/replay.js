"use strict";
// Plays the episode that the page holds as JSON. A state is a tick: 0 is the world before the first one.
(() => {
  const WORLD = 1000, SVG = "http://www.w3.org/2000/svg";
  const STATUS = { S: "success", F: "failure", R: "running", ".": "none" };
  const CUE = { S: "✓", F: "✗", R: "…", ".": "" };
  const LIMIT = { smallest: 0.2, readable: 0.7, largest: 4 };
  const MARK = { shade: 1, label: "", to_x: 0, to_y: 0, angle: 0 };

  const find = (name) => document.getElementById(name);
  const episode = JSON.parse(find("episode").textContent);
  const last = episode.frames.length;
  const stops = [...new Set(episode.stops.map(([tick]) => tick))];
  let now = 0, timer = null;

  function create(tag, parent, attributes = {}) {
    const made = parent.appendChild(document.createElementNS(SVG, tag));
    for (const [key, value] of Object.entries(attributes)) made.setAttribute(key, value);
    return made;
  }

  // The world: a group for each mark, drawn anew when the mark changes.
  const [left, bottom, right, top] = episode.box;
  const scale = WORLD / Math.max(right - left, 1e-9);
  const canvas = find("world");
  canvas.setAttribute("viewBox", `0 0 ${WORLD} ${Math.max((top - bottom) * scale, 1)}`);
  let marks = [], groups = [], drawn = 0;

  const place = (x, y) => [(x - left) * scale, (top - y) * scale];
  const around = (x, y, size, corners, turn) => corners.map(([a, b]) =>
    `${x + size * (a * Math.cos(turn) + b * Math.sin(turn))},${y + size * (b * Math.cos(turn) - a * Math.sin(turn))}`).join(" ");
  const SQUARE = [[-0.5, -0.5], [0.5, -0.5], [0.5, 0.5], [-0.5, 0.5]];
  const TRIANGLE = [[0.6, 0], [-0.4, 0.45], [-0.4, -0.45]];

  function draw(number) {
    const mark = marks[number], group = groups[number] ??= create("g", canvas);
    group.setAttribute("class", mark.role);
    group.replaceChildren();
    const [x, y] = place(mark.x, mark.y), size = mark.size * scale;
    const look = { class: "filled", "fill-opacity": mark.shade, "stroke-opacity": mark.shade };
    if (mark.shape === "circle") create("circle", group, { cx: x, cy: y, r: size / 2, ...look });
    if (mark.shape === "square") create("polygon", group, { points: around(x, y, size, SQUARE, mark.angle), ...look });
    if (mark.shape === "triangle") create("polygon", group, { points: around(x, y, size, TRIANGLE, mark.angle), ...look });
    if (mark.shape === "line") {
      const [x2, y2] = place(mark.to_x, mark.to_y);
      create("line", group, { x1: x, y1: y, x2, y2, "stroke-width": Math.max(size, 1), "stroke-opacity": mark.shade });
    }
    if (mark.label && mark.shade > 0) write(group, mark, x, y, size);
  }

  function write(group, mark, x, y, size) {
    const plain = mark.shape === "text";
    const text = create("text", group, { x, y: plain ? y + size / 3 : y - size / 2 - 5, "font-size": plain ? size : 22 });
    text.textContent = mark.label;
  }

  function showWorld(tick) {
    if (tick < drawn || groups.length === 0) {
      marks = episode.marks.map((mark) => ({ ...MARK, ...mark }));
      groups.slice(marks.length).forEach((group) => group.remove());
      groups.length = Math.min(groups.length, marks.length);
      marks.forEach((_, number) => draw(number));
      drawn = 0;
    }
    const changed = new Set();
    for (; drawn < tick; drawn++) {
      for (const [number, news] of episode.frames[drawn][2]) {
        marks[number] = { ...MARK, ...marks[number], ...news };
        changed.add(number);
      }
    }
    [...changed].sort((a, b) => a - b).forEach(draw);
  }

  // The tree: its drawing holds a group for each node, in pre-order, as the letters of a line of statuses.
  const picture = find("tree"), region = picture.parentElement;
  const nodes = [...picture.querySelectorAll(":scope > g")];
  const width = picture.viewBox.baseVal.width, height = picture.viewBox.baseVal.height;
  let zoom = 1;
  const cues = nodes.map((node) => {
    const box = node.firstElementChild.getBBox();
    return create("text", node, { class: "cue", x: box.x + box.width - 1, y: box.y + 6 });
  });

  function resize(wanted) {
    zoom = Math.min(LIMIT.largest, Math.max(LIMIT.smallest, wanted));
    picture.setAttribute("width", width * zoom);
    picture.setAttribute("height", height * zoom);
  }

  function showTree(tick) {
    const letters = tick ? episode.statuses[episode.frames[tick - 1][0]] : ".".repeat(nodes.length);
    nodes.forEach((node, number) => {
      node.dataset.status = STATUS[letters[number]];
      cues[number].textContent = CUE[letters[number]];
    });
    const lowest = letters.length - 1 - [...letters].reverse().findIndex((letter) => letter !== ".");
    if (find("follow").checked && lowest < letters.length) reveal(nodes[lowest]);
  }

  function reveal(node) {
    const box = node.firstElementChild.getBBox();
    const x = (box.x + box.width / 2) * zoom, y = (box.y + box.height / 2) * zoom, rim = 60;
    if (x < region.scrollLeft + rim || x > region.scrollLeft + region.clientWidth - rim) region.scrollLeft = x - region.clientWidth / 2;
    if (y < region.scrollTop + rim || y > region.scrollTop + region.clientHeight - rim) region.scrollTop = y - region.clientHeight / 2;
  }

  // Going from tick to tick.
  function show(tick) {
    now = Math.min(last, Math.max(0, tick));
    showWorld(now);
    showTree(now);
    find("tick").value = now;
    const reward = now ? episode.frames[now - 1][1] : 0;
    const told = episode.stops.filter(([at]) => at === now).map(([, text]) => text).join(", ");
    const line = `Tick ${now} of ${last}, ${episode.unit || "reward"} ${reward}${told ? `: ${told}` : ""}`;
    find("now").textContent = line;
    find("tick").setAttribute("aria-valuetext", line);
    const past = stops.filter((at) => at <= now).at(-1);
    document.querySelectorAll(".stop").forEach((stop) => {
      stop.toggleAttribute("aria-current", Number(stop.dataset.tick) === past);
    });
    if (now === last) pause();
  }

  function pause() {
    clearInterval(timer);
    timer = null;
    find("play").textContent = "Play";
    find("now").setAttribute("aria-live", "polite");
  }

  function play() {
    if (now === last) show(0);
    clearInterval(timer);
    timer = setInterval(() => show(now + 1), 1000 / Number(find("speed").value));
    find("play").textContent = "Pause";
    find("now").setAttribute("aria-live", "off"); // nobody can listen to sixty ticks a second
  }

  const go = (tick) => { pause(); show(tick); };
  function hasten(by) {
    const speed = find("speed");
    speed.selectedIndex = Math.min(speed.length - 1, Math.max(0, speed.selectedIndex + by));
    if (timer) play();
  }

  const does = {
    start: () => go(0),
    "previous-stop": () => go(stops.filter((at) => at < now).at(-1) ?? 0),
    back: () => go(now - 1),
    play: () => (timer ? pause() : play()),
    forward: () => go(now + 1),
    "next-stop": () => go(stops.find((at) => at > now) ?? last),
    end: () => go(last),
    larger: () => resize(zoom * 1.25),
    smaller: () => resize(zoom / 1.25),
  };
  const keys = {
    Home: does.start, p: does["previous-stop"], ArrowLeft: does.back, " ": does.play, ArrowRight: does.forward,
    n: does["next-stop"], End: does.end, "+": () => hasten(1), "-": () => hasten(-1), z: does.larger, x: does.smaller,
  };
  const OWN = { " ": "button, select, summary, input[type=checkbox]", other: "select, input[type=range], .scroll" };

  for (const [name, action] of Object.entries(does)) find(name).addEventListener("click", action);
  document.querySelectorAll(".stop").forEach((stop) => stop.addEventListener("click", () => go(Number(stop.dataset.tick))));
  find("tick").addEventListener("input", (event) => go(Number(event.target.value)));
  find("speed").addEventListener("change", () => { if (timer) play(); });
  document.addEventListener("keydown", (event) => {
    const action = keys[event.key];
    const moves = event.key.length > 1; // arrows, Home and End move sliders and scroll regions
    const taken = event.key === " " ? OWN[" "] : moves ? OWN.other : "select";
    if (!action || event.ctrlKey || event.metaKey || event.altKey || event.target.closest?.(taken)) return;
    event.preventDefault();
    action();
  });
  resize(Math.min(1, Math.max(LIMIT.readable, region.clientWidth / width)));
  show(0);
})();
