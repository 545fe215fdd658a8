-- The picture of one layer of a painting, cropped to whole pixels around the art.

--- Draws an object for a painting of w x h units, at `fine` pixels per unit. Returns { x =, y =,
--- png = }: its corner in pixels and the bytes of the file.
return function(art, w, h, fine)
  local x, y, width, height = art:scale(fine):bounds()
  local x0, y0 = math.max(0, math.floor(x)), math.max(0, math.floor(y))
  local x1 = math.min(math.tointeger(fine * w // 1), math.ceil(x + width))
  local y1 = math.min(math.tointeger(fine * h // 1), math.ceil(y + height))
  local path = os.tmpname() .. ".png"
  assert(render(rostrum { cel { art } }, path, {
    size = { fine * w // 1, fine * h // 1 }, film = { w, h },
    crop = { x0, y0, x1 - x0, y1 - y0 } }))
  local file = assert(io.open(path, "rb"))
  local bytes = file:read "a"
  file:close()
  os.remove(path)
  return { x = x0, y = y0, png = bytes }
end
