-- The colours of pencil.lua: two palettes with the same names.
return {
  day = {
    skin = "#a3c94a", belly = "#fbf0c4", leg = "#86ad3d", hand = "#b9da62", eye = "#fffaf0",
    pupil = "#2d2438", mouth = "#8a3546", tongue = "#ef8a86", line = "#3b3a2c",
    sky = "#6fc3cf", haze = "#fdebc9", sun = "#fff6da", cloud = "#f6f3e2", hill = "#a8d0b4",
    wood = "#76b096", far = "#cfe8d4", water = "#3f98a3", gleam = "#e4f4e2", pad = "#3f8f72",
    rim = "#72bb8b", reed = "#20594a", flower = "#f596ab", petal = "#ffd2d8", fly = "#ffd84a" },
  night = {
    skin = "#5aa38f", belly = "#cfd8b6", leg = "#3f8480", hand = "#72b9a0", eye = "#f1f0d8",
    pupil = "#15102e", mouth = "#571f45", tongue = "#b25f8b", line = "#10203c",
    sky = "#10123a", haze = "#5b4f93", sun = "#f6efce", cloud = "#3c3a78", hill = "#353b7d",
    wood = "#232a61", far = "#57609f", water = "#161f52", gleam = "#8d93c8", pad = "#1d4c66",
    rim = "#34767f", reed = "#0b1233", flower = "#a05a9c", petal = "#d08fc0", fly = "#fff07a" },
}
