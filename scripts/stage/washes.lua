local function wash(x, y, size, colour, seed)
  -- a few uneven layers of thin colour
  local layers = union {}
  for layer = 1, 4 do
    local points = {}
    for i = 1, 12 do
      local r = size * (0.8 + 0.35 * random(seed)(i + 20 * layer))
      points[i] = {
        x + r * math.cos(i * math.pi / 6),
        y + 0.8 * r * math.sin(i * math.pi / 6) }
    end
    layers = layers | nurbs { points = points, fill = rgb(colour, 0.34) }
  end
  return layers
end

return wash
