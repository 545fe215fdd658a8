-- A card of the size that pages show of a link.
local font = "scripts/type/block.ttf"
return film { size = { 1200, 630 }, frames = 1, frame = function()
  return rostrum { back = "#f3ead6", cel {
    rect { 80, 90, 160, 14, fill = "#e0654f" },
    text { "How lists of spans draw a whole film", font = font, size = 76, at = { 80, 190 },
      width = 1040, fill = "#232942" },
    text { "28 November, 7 minutes", font = font, size = 34, at = { 80, 560 },
      fill = "#8d4a3b" } } }
end }
