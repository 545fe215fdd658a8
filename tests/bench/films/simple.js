// A frame of the film of tests/bench/scripts/simple.lua on a canvas, in a browser or in Node: on the
// context `pen`.
const COLOURS = ["#e4572e", "#f3a712", "#2e86ab"];

function vertical(pen, top, foot) {
  const down = pen.createLinearGradient(0, 0, 0, 720);
  down.addColorStop(0, top);
  down.addColorStop(1, foot);
  return down;
}

function drawBackground(pen) {
  pen.fillStyle = vertical(pen, "#16202e", "#7a5c74");
  pen.fillRect(0, 0, 1280, 720);
  pen.fillStyle = vertical(pen, "#3d5a6c", "#16202e");
  for (let i = 0; i < 5; i++) {
    pen.beginPath();
    pen.moveTo(0, 720);
    for (let x = 0; x <= 1280; x += 16)
      pen.lineTo(x, 420 + 60 * i + 40 * Math.sin(x / (90 + 30 * i) + 2 * i));
    pen.lineTo(1280, 720);
    pen.fill();
  }
}

function draw(pen, frame) {
  const u = frame / 149;
  drawBackground(pen);
  pen.globalAlpha = 0.9;
  for (let i = 0; i < 30; i++) {
    const radius = 30 + 3 * i;
    const x = (1 - u) * (173 * i % 1280) + u * (311 * i % 1280);
    const y = (1 - u) * (97 * i % 720) + u * ((59 * i + 300) % 720);
    const light = pen.createRadialGradient(x, y, 0, x, y, radius);
    light.addColorStop(0, "#fff4d6");
    light.addColorStop(1, COLOURS[i % 3]);
    pen.fillStyle = light;
    pen.beginPath();
    pen.arc(x, y, radius, 0, 2 * Math.PI);
    pen.fill();
  }
  pen.globalAlpha = 1;
  pen.font = "bold 96px 'DejaVu Sans'";
  pen.textAlign = "center";
  pen.fillStyle = "#f6ead2";
  pen.fillText("Six seconds", 640, 160);
}

if (typeof module !== "undefined") module.exports = { draw };
