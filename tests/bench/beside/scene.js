// A frame of the film on a canvas, in a browser or in Node: on the context `pen`, with the drawing
// `owl` as an image.
const COLOURS = ["#e4572e", "#f3a712", "#2e86ab"];

function draw(pen, frame, owl) {
  const sky = pen.createLinearGradient(0, 0, 0, 720);
  sky.addColorStop(0, "#16202e");
  sky.addColorStop(1, "#7a5c74");
  pen.fillStyle = sky;
  pen.fillRect(0, 0, 1280, 720);
  const u = frame / 149;
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
  pen.drawImage(owl, 880, 330);
  pen.font = "bold 96px 'DejaVu Sans'";
  pen.textAlign = "center";
  pen.fillStyle = "#f6ead2";
  pen.fillText("Six seconds", 640, 160);
}

if (typeof module !== "undefined") module.exports = { draw };
