// Turns the grid: panels, members and nodes drawn from the farthest to the nearest on a canvas.
(() => {
  "use strict";
  const canvas = document.getElementById("view");
  const pen = canvas.getContext("2d");
  const data = JSON.parse(document.getElementById("grid").textContent);
  const bytes = (text) => Uint8Array.from(atob(text), (c) => c.charCodeAt(0));
  const xyz = new Float32Array(bytes(data.xyz).buffer);
  const members = new Uint32Array(bytes(data.members).buffer);
  const panels = new Uint32Array(bytes(data.panels).buffer);
  const wide = bytes(data.wide);
  const excess = new Int8Array(bytes(data.excess).buffer);
  const colourings = {};
  for (const [key, c] of Object.entries(data.colourings)) {
    colourings[key] = { inks: c.inks, on: c.on, steps: bytes(c.steps) };
  }
  const NO_STEP = 255;
  // The ink of an element; undefined without.
  function ink(colours, on, k) {
    if (!colours || colours.on !== on || colours.steps[k] === NO_STEP) return undefined;
    return colours.inks[colours.steps[k]];
  }

  const PLAIN = "#6b7075";
  const INK = "#1a1c1f";
  const PANEL = [246, 248, 250];
  // Beyond this many elements, panels are left out while the grid is turned.
  const MANY = 60000;
  const FAR = 3;

  const nodeCount = xyz.length / 3;
  const memberCount = members.length / 2;
  const panelCount = panels.length / 3;
  let radius = 0;
  for (let i = 0; i < xyz.length; i += 3) {
    radius = Math.max(radius, Math.hypot(xyz[i], xyz[i + 1], xyz[i + 2]));
  }
  const normals = new Float32Array(panels.length);
  for (let k = 0; k < panelCount; k++) {
    const [a, b, c] = [0, 1, 2].map((j) => 3 * panels[3 * k + j]);
    const u = [0, 1, 2].map((j) => xyz[b + j] - xyz[a + j]);
    const v = [0, 1, 2].map((j) => xyz[c + j] - xyz[a + j]);
    const n = [
      u[1] * v[2] - u[2] * v[1],
      u[2] * v[0] - u[0] * v[2],
      u[0] * v[1] - u[1] * v[0],
    ];
    const length = Math.hypot(...n) || 1;
    for (let j = 0; j < 3; j++) normals[3 * k + j] = n[j] / length;
  }

  // Turned as in the perspective picture; zoom and place follow from the canvas.
  const HOME = { turn: -0.54, tilt: 0.56, zoom: 1, right: 0, up: 0 };
  let eye = null;
  let showPanels = true;
  let dragging = false;
  let asked = false;

  const seen = new Float32Array(3 * nodeCount);
  const depth = new Float32Array(panelCount + memberCount + nodeCount);
  let order = new Uint32Array(0);

  function look(width, height) {
    const [cz, sz] = [Math.cos(eye.turn), Math.sin(eye.turn)];
    const [cx, sx] = [Math.cos(eye.tilt), Math.sin(eye.tilt)];
    const away = FAR * radius;
    const scale = (0.47 * Math.min(width, height) * eye.zoom) / radius;
    for (let i = 0; i < xyz.length; i += 3) {
      const [x, y, z] = [xyz[i], xyz[i + 1], xyz[i + 2]];
      const right = cz * x + sz * y;
      const into = -sz * x + cz * y;
      const up = cx * z + sx * into;
      const far = away + cx * into - sx * z;
      const shrink = (scale * away) / Math.max(far, 0.05 * away);
      seen[i] = width / 2 + eye.right + right * shrink;
      seen[i + 1] = height / 2 + eye.up - up * shrink;
      seen[i + 2] = far;
    }
    const towards = [sz * cx, -cz * cx, sx];
    return { scale, towards };
  }

  // The view from home that fills the canvas.
  function fit(width, height) {
    eye = { ...HOME };
    look(width, height);
    const low = [Infinity, Infinity];
    const high = [-Infinity, -Infinity];
    for (let i = 0; i < seen.length; i += 3) {
      for (const k of [0, 1]) {
        low[k] = Math.min(low[k], seen[i + k]);
        high[k] = Math.max(high[k], seen[i + k]);
      }
    }
    const size = [0, 1].map((k) => Math.max(high[k] - low[k], 1));
    eye.zoom = 0.93 * Math.min(width / size[0], height / size[1]);
    eye.right = -eye.zoom * ((low[0] + high[0]) / 2 - width / 2);
    eye.up = -eye.zoom * ((low[1] + high[1]) / 2 - height / 2);
  }

  function sorted(drawPanels, colours) {
    const before = 0.35 * data.member_length;
    const all = [];
    for (let k = 0; k < panelCount && drawPanels; k++) {
      const p = 3 * k;
      depth[k] =
        (seen[3 * panels[p] + 2] + seen[3 * panels[p + 1] + 2] + seen[3 * panels[p + 2] + 2]) / 3;
      all.push(k);
    }
    for (let k = 0; k < memberCount; k++) {
      const i = panelCount + k;
      depth[i] = (seen[3 * members[2 * k] + 2] + seen[3 * members[2 * k + 1] + 2]) / 2 - before;
      all.push(i);
    }
    for (let v = 0; v < nodeCount; v++) {
      if (excess[v] === 0 && !ink(colours, "nodes", v)) continue;
      const i = panelCount + memberCount + v;
      depth[i] = seen[3 * v + 2] - 2 * before;
      all.push(i);
    }
    order = Uint32Array.from(all).sort((a, b) => depth[b] - depth[a]);
  }

  function draw() {
    asked = false;
    const ratio = window.devicePixelRatio || 1;
    const [width, height] = [canvas.clientWidth, canvas.clientHeight];
    canvas.width = Math.round(width * ratio);
    canvas.height = Math.round(height * ratio);
    pen.setTransform(ratio, 0, 0, ratio, 0, 0);
    pen.fillStyle = "#fff";
    pen.fillRect(0, 0, width, height);
    pen.lineJoin = "round";
    pen.lineCap = "round";
    if (!eye) fit(width, height);
    const { scale, towards } = look(width, height);
    const many = panelCount + memberCount > MANY;
    const colours = colourings[document.body.dataset.colour];
    sorted(showPanels && !(dragging && many), colours);
    const thin = Math.min(3, Math.max(0.7, 0.055 * data.member_length * scale));
    const large = colours?.on === "nodes" ? 1.6 : 1;
    const dot = large * Math.min(7, Math.max(1.5, 0.13 * data.member_length * scale));
    for (const i of order) {
      if (i < panelCount) panel(i, colours, towards);
      else if (i < panelCount + memberCount) member(i - panelCount, colours, thin);
      else node(i - panelCount - memberCount, colours, dot);
    }
  }

  function panel(k, colours, towards) {
    const n = 3 * k;
    const facing = normals[n] * towards[0] + normals[n + 1] * towards[1] + normals[n + 2] * towards[2];
    // The light of the pictures: from the left, the front and above.
    const lit = Math.abs(-0.358 * normals[n] - 0.268 * normals[n + 1] + 0.894 * normals[n + 2]);
    const bright = 1 - 0.35 * (1 - lit) - (facing < 0 ? 0.12 : 0);
    const own = ink(colours, "panels", k);
    const rgb = own ? [1, 3, 5].map((j) => parseInt(own.slice(j, j + 2), 16)) : PANEL;
    const fill = `rgb(${rgb.map((x) => Math.round(x * bright)).join(",")})`;
    pen.beginPath();
    for (let j = 0; j < 3; j++) {
      const v = 3 * panels[n + j];
      if (j === 0) pen.moveTo(seen[v], seen[v + 1]);
      else pen.lineTo(seen[v], seen[v + 1]);
    }
    pen.closePath();
    pen.fillStyle = fill;
    pen.strokeStyle = fill;
    pen.lineWidth = 0.6;
    pen.fill();
    pen.stroke();
  }

  function member(k, colours, thin) {
    const [a, b] = [3 * members[2 * k], 3 * members[2 * k + 1]];
    pen.strokeStyle = ink(colours, "members", k) ?? PLAIN;
    pen.lineWidth = wide[k] ? 1.8 * thin : thin;
    pen.beginPath();
    pen.moveTo(seen[a], seen[a + 1]);
    pen.lineTo(seen[b], seen[b + 1]);
    pen.stroke();
  }

  function node(v, colours, dot) {
    pen.fillStyle = ink(colours, "nodes", v) ?? (excess[v] < 0 ? INK : "#fff");
    pen.strokeStyle = excess[v] === 0 ? pen.fillStyle : INK;
    pen.lineWidth = 0.25 * dot;
    pen.beginPath();
    pen.arc(seen[3 * v], seen[3 * v + 1], dot, 0, 2 * Math.PI);
    pen.fill();
    pen.stroke();
  }

  function ask() {
    if (asked) return;
    asked = true;
    requestAnimationFrame(draw);
  }

  // One pointer turns or moves, two zoom.
  const pointers = new Map();
  canvas.addEventListener("pointerdown", (e) => {
    canvas.setPointerCapture(e.pointerId);
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    dragging = true;
  });
  canvas.addEventListener("pointermove", (e) => {
    const before = pointers.get(e.pointerId);
    if (!before || !eye) return;
    const [dx, dy] = [e.clientX - before[0], e.clientY - before[1]];
    if (pointers.size === 2) {
      const other = [...pointers].find(([id]) => id !== e.pointerId)[1];
      const apart = (p) => Math.hypot(p[0] - other[0], p[1] - other[1]) || 1;
      zoom(apart([e.clientX, e.clientY]) / apart(before));
    } else if (e.shiftKey || e.buttons & 2) {
      eye.right += dx;
      eye.up += dy;
    } else {
      eye.turn -= dx * 0.008;
      eye.tilt = Math.min(1.57, Math.max(-1.57, eye.tilt + dy * 0.008));
    }
    pointers.set(e.pointerId, [e.clientX, e.clientY]);
    ask();
  });
  for (const kind of ["pointerup", "pointercancel"]) {
    canvas.addEventListener(kind, (e) => {
      pointers.delete(e.pointerId);
      dragging = pointers.size > 0;
      ask();
    });
  }
  canvas.addEventListener("contextmenu", (e) => e.preventDefault());
  canvas.addEventListener(
    "wheel",
    (e) => {
      e.preventDefault();
      zoom(Math.exp(-0.0012 * e.deltaY));
    },
    { passive: false },
  );
  canvas.addEventListener("dblclick", () => {
    eye = null;
    ask();
  });
  canvas.addEventListener("keydown", (e) => {
    const step = { ArrowLeft: [0.1, 0], ArrowRight: [-0.1, 0], ArrowUp: [0, -0.1], ArrowDown: [0, 0.1] }[e.key];
    if (!eye) return;
    if (step) {
      eye.turn += step[0];
      eye.tilt += step[1];
    } else if (e.key === "+") zoom(1.2);
    else if (e.key === "-") zoom(1 / 1.2);
    else return;
    e.preventDefault();
    ask();
  });
  function zoom(by) {
    if (!eye) return;
    const to = Math.min(60, Math.max(0.1, eye.zoom * by));
    // The middle of the canvas stays where it is.
    eye.right *= to / eye.zoom;
    eye.up *= to / eye.zoom;
    eye.zoom = to;
    ask();
  }

  for (const input of document.querySelectorAll("input[name=colour]")) {
    input.addEventListener("change", () => {
      document.body.dataset.colour = input.value;
      ask();
    });
    // Browsers remember the choice over a reload.
    if (input.checked) document.body.dataset.colour = input.value;
  }
  document.getElementById("panels").addEventListener("change", (e) => {
    showPanels = e.target.checked;
    ask();
  });
  new ResizeObserver(ask).observe(canvas);
  ask();
})();
