-- A decoder of plane files, written only from docs/planefile.md: all bytes in; all pixels of a size
-- and a frame out, as means of linear light. Pictures of a name are asked for by a function. One
-- file, so that a reader can follow it beside the page from top to bottom.

local SIDE = 1 << 26

local function crc32c(bytes)
  local sum = 0xffffffff
  for i = 1, #bytes do
    sum = sum ~ bytes:byte(i)
    for _ = 1, 8 do sum = sum & 1 == 1 and sum >> 1 ~ 0x82f63b78 or sum >> 1 end
  end
  return sum ~ 0xffffffff
end

---------------------------------------------------------------------- numbers

local function new_models() return setmetatable({}, {__index = function() return 2048 end}) end

-- models: what the code of a base has learned, or nil.
local function new_coder(bytes, models)
  models = models or {}
  local coder = {range = 0xffffffff, code = (">I4"):unpack(bytes), at = 5, models = models}
  local function widen()
    while coder.range < 1 << 24 do
      coder.code = coder.code << 8 & 0xffffffff | (bytes:byte(coder.at) or error("too short"))
      coder.range, coder.at = coder.range << 8, coder.at + 1
    end
  end
  local function bit(tree, node)
    local model = tree[node]
    local bound = (coder.range >> 12) * model
    local is_one = coder.code >= bound
    if is_one then
      coder.code, coder.range = coder.code - bound, coder.range - bound
      tree[node] = model - (model >> 4)
    else
      coder.range, tree[node] = bound, model + (4096 - model >> 4)
    end
    widen()
    return is_one and 1 or 0
  end
  local function plain(bits)
    local number = 0
    for _ = 1, bits do
      coder.range = coder.range >> 1
      local is_one = coder.code >= coder.range
      if is_one then coder.code = coder.code - coder.range end
      number = number << 1 | (is_one and 1 or 0)
      widen()
    end
    return number
  end
  local function tree_of(name)
    models[name] = models[name] or new_models()
    return models[name]
  end
  function coder.symbol(name, bits)
    local tree, node = tree_of(name), 1
    for _ = 1, bits do node = 2 * node + bit(tree, node) end
    return node - (1 << bits)
  end
  function coder.number(name)
    local class = math.min(coder.symbol(name, 6), 32)
    if class == 0 then return 0 end
    local led = math.min(class - 1, 2)
    local number = 1 << led | coder.symbol(name .. " leading " .. class, led)
    return number << class - 1 - led | plain(class - 1 - led)
  end
  function coder.signed(name)
    local number = coder.number(name)
    return number ~= 0 and bit(tree_of(name .. " sign"), 1) == 1 and -number or number
  end
  return coder
end

---------------------------------------------------------------------- a band

local function new_band(payload, flags, grid, base)
  local varies = flags & 2 > 0
  local band = {cells = {}, chains = {}, borders = {}, form = 0, varies = varies, axes = {},
    is_coded = flags & 8 > 0, cell_number = 0, flat = {0, 0, 0, 0}, stop = {0, 0, 0, 0},
    shade = flags & 8 > 0 and 17 or 1, grid = grid}
  band.top, band.foot, band.chain_count, band.piece_count, band.cell_count, band.change_count,
    band.border_count = ("<I4I4I4I4I4I4I4"):unpack(payload)
  band.coder = new_coder(payload:sub(varies and 41 or 29), base and base.coder.models)
  return band
end

-- shade: the step of the channels; nil: 1.
local function get_channels(band, name, from, shade)
  local channels = {}
  for c = 1, 4 do channels[c] = from[c] + (shade or 1) * band.coder.signed(name .. c) end
  return channels
end

-- A colour of a program.
local function get_shades(band, name, from) return get_channels(band, name, from, band.shade) end

local function get_double(band, name)
  local bytes = {}
  for i = 1, 8 do bytes[i] = string.char(band.coder.symbol(name .. " byte " .. i, 8)) end
  return (("<d"):unpack(table.concat(bytes)))
end

local function get_plane(band)
  return {get_double(band, "axis"), get_double(band, "axis"), get_double(band, "axis")}
end

local function get_axis(band)
  local axis = {kind = band.coder.symbol("axis kind", 2)}
  local is_wide = band.coder.symbol("is wide", 1) == 1
  axis.p = get_plane(band)
  axis.q = axis.kind > 0 and get_plane(band) or {0, 0, 0}
  axis.w = is_wide and get_plane(band) or {0, 0, 1}
  axis.focus = axis.kind == 1 and get_double(band, "axis") or 0
  if axis.kind == 3 then
    axis.picture = band.coder.number("picture")
    axis.wrap, axis.filter = band.coder.symbol("wrap", 2), band.coder.symbol("filter", 2)
  end
  return axis
end

local function get_ramp(band, step)
  local back = band.coder.number("axis")
  if back == 0 then band.axes[#band.axes + 1] = get_axis(band) end
  step.axis = band.axes[#band.axes + (back == 0 and 0 or 1 - back)]
  for i = 1, band.coder.number("stops") + 1 do
    local at = get_double(band, "stop")
    band.stop = get_shades(band, "stop ", band.stop)
    step[i] = {at = at, colour = band.stop}
  end
end

local function get_step(band)
  local step = {kind = band.coder.symbol("kind", 2)}
  if step.kind == 0 then
    step.colour = get_shades(band, "flat ", {0, 0, 0, 0})
  elseif step.kind == 1 then
    get_ramp(band, step)
  elseif step.kind == 3 then
    step.how = band.coder.symbol("how", 4)
    step.factors = get_shades(band, "factor ", {65535, 65535, 65535, 65535})
  end
  return step
end

-- Channels between -2^24 and 2^24.
local function limit(value) return math.max(-(1 << 24), math.min(1 << 24, value)) end

-- What the member of a group guesses of a cell, if it is next to it and knows the one beside it.
local function guess(band, member, number)
  local side = member.sides[1] == number and 1 or 2
  local was, is = member.before[3 - side], member.sides[3 - side]
  local known = {band.cells[was + 1], band.cells[member.before[side] + 1], band.cells[is + 1]}
  if member.slope == 0 or member.sides[side] ~= number or is >= number then return nil end
  for i = 1, 3 do if known[i].program then return nil end end
  local slope, out = math.abs(member.slope), {}
  for c = 1, 4 do
    local way = known[3][c] - known[1][c]
    if (member.slope > 0) == (side == 2) then
      out[c] = limit(known[2][c] + (way * slope + 32768) // 65536)
    else
      out[c] = limit(known[2][c] + (way * 65536 + slope // 2) // slope)
    end
  end
  return out
end

-- The light of a code of sRGB, from 0 to 1.
local function decode(code)
  if code < 0 then return -decode(-code) end
  return code <= 0.04045 and code / 12.92 or ((code + 0.055) / 1.055) ^ 2.4
end

-- The least light that has a code or a greater one.
local function light_of(code)
  return math.max(0, math.ceil(decode(code / 255) * 65535 - 1e-7))
end

local function code_of(light)
  local code = 0
  while code < 255 and light_of(code + 0.5) <= light do code = code + 1 end
  return code
end

local function codes_of(cell)
  local alpha = math.max(0, math.min(65535, cell[4]))
  local out = {0, 0, 0, (alpha * 255 + 32767) // 65535}
  for c = 1, 3 do
    if out[4] > 0 then out[c] = code_of((math.max(0, cell[c]) * 65535 + alpha // 2) // alpha) end
  end
  return out
end

local function cell_of(codes)
  local cell = {0, 0, 0, codes[4] * 257}
  for c = 1, 3 do cell[c] = (light_of(codes[c]) * codes[4] + 127) // 255 end
  return cell
end

-- The content of a new cell. members: of the group in which it is new.
local function get_content(band, number, members)
  local cell = {0, 0, 0, 0}
  if band.varies and band.coder.symbol("varies", 1) == 1 then
    cell.program = {}
    for i = 1, band.coder.number("steps") + 1 do cell.program[i] = get_step(band) end
  else
    local guesses = {}
    for _, member in ipairs(members or {}) do
      if #guesses < 3 then guesses[#guesses + 1] = guess(band, member, number) end
    end
    local choice = #guesses > 0 and band.coder.symbol("guess", 2) or 0
    local from = choice > 0 and guesses[choice] or band.flat
    local name = choice > 0 and "guessed channel " or "channel "
    cell = get_channels(band, name, band.is_coded and codes_of(from) or from)
    if band.is_coded then cell = cell_of(cell) end
    band.flat = cell
  end
  band.cells[number + 1] = cell
end

-- A new cell, whose content follows.
local function get_fresh(band)
  band.cell_number = band.cell_number + 1
  return band.cell_number - 1
end

local function get_contents(band, members)
  for number = #band.cells, band.cell_number - 1 do get_content(band, number, members) end
end

-- own, other, latest: pairs of cells, {left, right}.
local function get_sides(band, context, own, other, latest)
  local sides = {}
  for side = 1, 2 do
    local symbol = band.coder.symbol("cells " .. context + side - 1, 3)
    local second = side == 1 and own[1] or sides[1]
    local known = {0, second, own[2], other[1], other[2], latest[1], latest[2]}
    sides[side] = symbol == 0 and get_fresh(band)
      or symbol == 1 and band.cell_number - 1 - band.coder.number("older") or known[symbol]
  end
  return sides
end

-- A move to the next point; way: the move to this one; is_first: the piece begins.
local function get_way(coder, way, name, is_first)
  local main = math.abs(way[2]) > math.abs(way[1]) and 2 or 1
  local length, turn = math.abs(way[main]), {way[1] < 0 and -1 or 1, way[2] < 0 and -1 or 1}
  if is_first and length > 0 and coder.symbol("is smooth", 1) == 1 then
    local out, along = {}, coder.number("ahead")
    out[main] = along * turn[main]
    out[3 - main] = (2 * along * way[3 - main] + length) // (2 * length) + coder.signed("aside")
    return out
  end
  local x = coder.signed("x " .. name) * turn[1]
  return {x, coder.signed("y " .. name) * turn[2]}
end

-- way: the latest move of the chain; foot: where the piece ends, or nil.
local function get_piece(band, x, y, way, foot)
  local coder = band.coder
  band.form = coder.symbol("form after " .. band.form, 3)
  local degree, is_rational = band.form & 3, band.form >= 4
  local function weight() return is_rational and 1 + coder.signed("weight") / (1 << 28) or 1 end
  local piece = {{x, y, weight()}}
  for i = 1, degree do
    if foot and i == degree then
      x, y = foot[1], foot[2]
    else
      way = get_way(coder, way, degree .. i, i == 1)
      x, y = band.grid.move(x, way[1], 1), band.grid.move(y, way[2], 2)
    end
    piece[i + 1] = {x, y, weight()}
  end
  return piece, x, y, way
end

local function add_border(band, chain, foot)
  local left, right = chain.sides[1], chain.sides[2]
  if left == right then return end
  local change = {}
  for c = 1, 4 do change[c] = band.cells[right + 1][c] - band.cells[left + 1][c] end
  local border = {chain = chain, top = chain.since, foot = foot, change = change,
    sides = chain.sides,
    left = band.cells[left + 1], right = band.cells[right + 1]}
  band.borders[#band.borders + 1], chain.borders[#chain.borders + 1] = border, border
end

-- A chain's cells at its top. own: those that it has in the base.
local function get_top(band, chain, before, own)
  local count = #band.chains
  local latest, other = before[count] or {0, 0}, before[count - 1] or {0, 0}
  chain.sides = get_sides(band, 0, own, other, latest)
  get_contents(band)
  chain.slope = band.coder.signed("slope")
end

-- Moves a place by some steps.
local function move(band, at, name)
  at.x = band.grid.move(at.x, band.coder.signed(name .. " x"), 1)
  at.y = band.grid.move(at.y, band.coder.signed(name .. " y"), 2)
end

local function get_start(band, start)
  local top = band.coder.number("top of")
  if top > 0 then
    local first = band.chains[#band.chains + 1 - top][1][1]
    start.x, start.y = first[1], first[2]
  else
    move(band, start, "start")
  end
end

-- Where the chain ends, if another one ends there.
local function get_foot(band)
  local foot = band.coder.number("foot of")
  local other = foot > 0 and band.chains[#band.chains + 1 - foot]
  return other and other[#other][#other[#other]] or nil
end

local function get_new_chain(band, chain, start, before)
  get_start(band, start)
  local pieces, last = band.coder.number("pieces") + 1, get_foot(band)
  get_top(band, chain, before, {0, 0})
  local x, y, way = start.x, start.y, {0, 0}
  for i = 1, pieces do
    chain[i], x, y, way = get_piece(band, x, y, way, i == pieces and last or nil)
  end
end

local function get_which(band)
  local number = band.next_old + band.coder.signed("which")
  band.next_old = number + 1
  return band.base.chains[number + 1]
end

-- The cells that a chain of the base had.
local function sides_of(old) return old.borders[1] and old.borders[1].sides or {0, 0} end

local function get_move(band)
  local symbol = band.coder.symbol("moved", 3)
  local by = table.remove(band.moves, symbol < 7 and symbol + 1 or 7)
  if symbol == 7 then
    by = {x = band.latest_move.x + band.coder.signed("shift x")}
    by.y = band.latest_move.y + band.coder.signed("shift y")
  end
  table.insert(band.moves, 1, by)
  band.latest_move = by
  return by
end

-- A chain of pieces like those of one of the base, with other moves.
local function get_bent_chain(band, chain, start, before)
  local old = get_which(band)
  get_start(band, start)
  local last = get_foot(band)
  get_top(band, chain, before, sides_of(old))
  local at = {x = start.x, y = start.y}
  for i, piece in ipairs(old) do
    chain[i] = {{at.x, at.y, piece[1][3]}}
    for k = 2, #piece do
      if last and i == #old and k == #piece then
        at = {x = last[1], y = last[2]}
      else
        local grid, from, to = band.grid, piece[k - 1], piece[k]
        at.x = grid.move(at.x, grid.step(to[1], 1) - grid.step(from[1], 1), 1)
        at.y = grid.move(at.y, grid.step(to[2], 2) - grid.step(from[2], 2), 2)
        move(band, at, "bent")
      end
      chain[i][k] = {at.x, at.y, piece[k][3]}
    end
  end
end

-- A chain of the base, moved; is_kept: with its borders.
local function get_old_chain(band, chain, start, before, is_kept)
  local old = get_which(band)
  local by = get_move(band)
  for i, piece in ipairs(old) do
    chain[i] = {}
    for k, p in ipairs(piece) do
      chain[i][k] = {band.grid.move(p[1], by.x, 1), band.grid.move(p[2], by.y, 2), p[3]}
    end
  end
  start.x, start.y = chain[1][1][1], chain[1][1][2]
  if not is_kept then
    return get_top(band, chain, before, sides_of(old))
  end
  for _, border in ipairs(old.borders) do
    chain.sides = border.sides
    chain.since = math.max(band.grid.move(border.top, by.y, 2), band.top)
    local foot = math.min(band.grid.move(border.foot, by.y, 2), band.foot)
    if chain.since < foot then add_border(band, chain, foot) end
  end
  chain.sides = {0, 0}
end

local function get_chain(band, start, before)
  local chain = {borders = {}}
  local origin = band.base and band.coder.symbol("origin", 2) or 0
  if origin == 0 then
    get_new_chain(band, chain, start, before)
  elseif origin == 3 then
    get_bent_chain(band, chain, start, before)
  else
    get_old_chain(band, chain, start, before, origin == 2)
  end
  before[#band.chains + 1] = chain.sides
  local last = chain[#chain]
  chain.since, chain.foot = math.max(start.y, band.top), math.min(last[#last][2], band.foot)
  band.chains[#band.chains + 1] = chain
end

local function get_group(band, height, first, latest, done)
  local size, members, before = band.coder.number("size") + 1, {}, {}
  for i = 1, size do
    first = i == 1 and first + band.coder.signed("first") or first
    members[i] = i == 1 and first or members[i - 1] + band.coder.signed("next")
    before[i] = band.chains[members[i] + 1].sides
  end
  for i, member in ipairs(members) do
    local chain = band.chains[member + 1]
    local other = i > 1 and i - 1 or size > 1 and 2 or 1
    local context = 2 + 4 * (math.min(size, 3) - 1) + (i > 1 and 2 or 0)
    add_border(band, chain, height)
    chain.sides = get_sides(band, context, before[i], before[other], latest)
    chain.since, latest = height, chain.sides
    members[i] = {sides = chain.sides, before = before[i], slope = chain.slope}
  end
  get_contents(band, members)
  return done + size, first, latest
end

-- A program of the base gets other colours.
local function recolour(band, program)
  for _, step in ipairs(program) do
    if step.kind == 0 then step.colour = get_shades(band, "recoloured flat ", step.colour) end
    for _, stop in ipairs(step) do
      stop.colour = get_shades(band, "recoloured stop ", stop.colour)
    end
    if step.kind == 3 then step.factors = get_shades(band, "recoloured factor ", step.factors) end
  end
end

-- What becomes of a cell of the base.
local function get_fate(band, number, cell)
  local fate = band.coder.symbol("fate", 2)
  if fate == 1 and cell.program then
    recolour(band, cell.program)
  elseif fate == 1 then
    local from = band.is_coded and codes_of(cell) or cell
    local channels = get_channels(band, "changed channel ", from)
    band.cells[number] = band.is_coded and cell_of(channels) or channels
  elseif fate == 2 then
    get_content(band, number - 1)
  end
  assert(fate < 3)
end

-- A band begins with the cells of its base, which may have changed.
local function begin_with(band, base)
  band.base, band.cells, band.axes = base, base.cells, base.axes
  band.cell_number = #band.cells
  band.next_old, band.moves, band.latest_move = 0, {}, {x = 0, y = 0}
  for i = 1, 7 do band.moves[i] = {x = 0, y = 0} end
  for _, axis in ipairs(band.axes) do
    if band.coder.symbol("is patched", 1) == 1 then
      local is_wide = not (axis.w[1] == 0 and axis.w[2] == 0 and axis.w[3] == 1)
      axis.p[3] = get_double(band, "axis")
      if axis.kind > 0 then axis.q[3] = get_double(band, "axis") end
      if is_wide then axis.w[3] = get_double(band, "axis") end
    end
  end
  for i = 1, #band.cells do get_fate(band, i, band.cells[i]) end
end

-- base: the band that it is made from, which is used up, or nil.
local function read_band(payload, flags, grid, base)
  local band, start, before = new_band(payload, flags, grid, base), {x = 0, y = 0}, {}
  if base then
    begin_with(band, base)
  else
    get_fresh(band)
    get_contents(band)
  end
  for _ = 1, band.chain_count do get_chain(band, start, before) end
  local height, first, latest, done = band.top, 0, {0, 0}, 0
  while done < band.change_count do
    height = band.grid.move(height, band.coder.number("height"), 2)
    done, first, latest = get_group(band, height, first, latest, done)
  end
  for _, chain in ipairs(band.chains) do add_border(band, chain, chain.foot) end
  assert(#band.borders == band.border_count and #band.cells == band.cell_count)
  return band
end

---------------------------------------------------------------------- pictures

-- A channel as it is foreseen, and its context.
local function foresee(rows, x, y, c)
  local row, upper = rows[y], rows[y - 1]
  local left, above = x > 0 and row[x - 1][c] or 0, upper and upper[x][c] or 0
  local corner = upper and x > 0 and upper[x - 1][c] or 0
  local change, context = math.abs(above - corner) + math.abs(left - corner), 0
  while change > 0 and context < 15 do change, context = change >> 1, context + 1 end
  local low, high = math.min(left, above), math.max(left, above)
  return corner >= high and low or corner <= low and high or left + above - corner, context
end

local function read_pixels(code, width, height)
  local coder, rows, green = new_coder(code), {}, 0
  for y = 0, height - 1 do
    rows[y] = {}
    for x = 0, width - 1 do
      local pixel = {}
      rows[y][x] = pixel
      for _, c in ipairs {4, 2, 1, 3} do
        local seen, context = foresee(rows, x, y, c)
        local off = coder.signed("channel " .. c .. " context " .. context)
        if c == 2 then green = off end
        pixel[c] = seen + off + ((c == 1 or c == 3) and green or 0)
      end
    end
  end
  return rows
end

local function copy_pixels(codes, width, height)
  local rows = {}
  for y = 0, height - 1 do
    rows[y] = {}
    for x = 0, width - 1 do
      local at = 4 * (y * width + x)
      rows[y][x] = {codes:byte(at + 1, at + 4)}
    end
  end
  return rows
end

-- Pixels as light, with 65535 for white.
local function to_light(rows, width, height, kind)
  for y = 0, height - 1 do
    for x = 0, kind == 1 and -1 or width - 1 do
      local codes = rows[y][x]
      local alpha = codes[4] / 255
      for c = 1, 3 do codes[c] = 65535 * alpha * decode(codes[c] / 255) end
      codes[4] = 65535 * alpha
    end
  end
  return {width = width, height = height, side = 1, rows = rows}
end

-- The level above: means by the pixels that exist.
local function halve(level, whole)
  local half = {width = (level.width + 1) // 2, height = (level.height + 1) // 2, rows = {},
    side = 2 * level.side}
  local function pixels_of(i, size) return math.min(level.side, size - i * level.side) end
  for y = 0, half.height - 1 do
    half.rows[y] = {}
    for x = 0, half.width - 1 do
      local sum, all = {0, 0, 0, 0}, 0
      for j = 2 * y, math.min(2 * y + 1, level.height - 1) do
        for i = 2 * x, math.min(2 * x + 1, level.width - 1) do
          local count = pixels_of(i, whole.width) * pixels_of(j, whole.height)
          all = all + count
          for c = 1, 4 do sum[c] = sum[c] + count * level.rows[j][i][c] end
        end
      end
      for c = 1, 4 do sum[c] = sum[c] / all end
      half.rows[y][x] = sum
    end
  end
  return half
end

local function read_picture(payload, host)
  local width, height, kind, key, at = ("<I4I4I4I8"):unpack(payload)
  local code = payload:sub(at)
  local rows = kind == 2 and copy_pixels(host(code, width, height, key), width, height)
    or read_pixels(code, width, height)
  local levels = {to_light(rows, width, height, kind)}
  while levels[#levels].width > 1 or levels[#levels].height > 1 do
    levels[#levels + 1] = halve(levels[#levels], levels[1])
  end
  return levels
end

local function texel_of(level, wrap, x, y)
  local function inside(i, size)
    return wrap == 2 and i % size or math.max(0, math.min(size - 1, i))
  end
  return level.rows[inside(y, level.height)][inside(x, level.width)]
end

-- The mean of texels; across and down: lists of {index, weight}.
local function mix_texels(level, wrap, across, down)
  local sum, all = {0, 0, 0, 0}, 0
  local low, high = {}, {}
  for _, row in ipairs(down) do
    for _, column in ipairs(across) do
      local texel, weight = texel_of(level, wrap, column[1], row[1]), row[2] * column[2]
      all = all + weight
      for c = 1, 4 do
        sum[c] = sum[c] + weight * texel[c]
        low[c] = math.min(low[c] or texel[c], texel[c])
        high[c] = math.max(high[c] or texel[c], texel[c])
      end
    end
  end
  for c = 1, 4 do sum[c] = math.max(low[c], math.min(high[c], sum[c] / all)) end
  return sum
end

local function split(at)
  local first = math.floor(at + 1e-6)
  return first, at - first > 1e-6 and at - first or 0
end

local function linear_of(at, side)
  local first, t = split(at / side - 0.5)
  return {{first, 1 - t}, {first + 1, t}}
end

local function cubic_of(at)
  local first, t = split(at - 0.5)
  return {{first - 1, (2 * t ^ 2 - t ^ 3 - t) / 2}, {first, (3 * t ^ 3 - 5 * t ^ 2 + 2) / 2},
    {first + 1, (4 * t ^ 2 - 3 * t ^ 3 + t) / 2}, {first + 2, (t ^ 3 - t ^ 2) / 2}}
end

local function box_of(low, high, side)
  local first, list = math.floor((low + 1e-6) / side), {}
  local last = math.max(first, math.ceil((high - 1e-6) / side) - 1)
  for i = first, last do
    local left, right = i > first and i * side or low, i < last and (i + 1) * side or high
    list[#list + 1] = {i, right > left and right - left or 1}
  end
  return list
end

local function reduce(wrap, at, size) return wrap == 2 and at - at // size * size or at end

-- The level on which a footprint is covered.
local function find_level(levels, shorter, longer, least, most)
  local number = 1
  while number < #levels and (shorter >= 2 * least or longer > most) do
    number, shorter, longer = number + 1, shorter / 2, longer / 2
  end
  return levels[number]
end

local function sample_linear(level, levels, wrap, u, v)
  return mix_texels(level, wrap, linear_of(reduce(wrap, u, levels[1].width), level.side),
    linear_of(reduce(wrap, v, levels[1].height), level.side))
end

local function sample_box(levels, wrap, u, v, wide, high)
  wide, high = math.max(wide, 1), math.max(high, 1)
  local level = find_level(levels, math.min(wide, high), math.max(wide, high), 4, 64)
  local function extent(at, length, size)
    at, length = reduce(wrap, at, size), math.min(length, 64 * level.side)
    local from, to = at - length / 2, at + length / 2
    if wrap < 2 then
      from, to = math.max(0, math.min(size, from)), math.max(0, math.min(size, to))
    end
    return box_of(from, to, level.side)
  end
  return mix_texels(level, wrap, extent(u, wide, levels[1].width),
    extent(v, high, levels[1].height))
end

local function sample_taps(levels, wrap, u, v, right, down)
  local wide = math.sqrt(right[1] ^ 2 + right[2] ^ 2)
  local high = math.sqrt(down[1] ^ 2 + down[2] ^ 2)
  local level = find_level(levels, math.min(wide, high), math.max(wide, high), 2, 16)
  local function taps(length)
    return math.max(1, math.min(16, math.ceil(length / level.side - 1e-6)))
  end
  local columns, rows, sum = taps(wide), taps(high), {0, 0, 0, 0}
  for j = 0, rows - 1 do
    for i = 0, columns - 1 do
      local x, y = (i + 0.5) / columns - 0.5, (j + 0.5) / rows - 0.5
      local tap = sample_linear(level, levels, wrap, u + x * right[1] + y * down[1],
        v + x * right[2] + y * down[2])
      for c = 1, 4 do sum[c] = sum[c] + tap[c] / (columns * rows) end
    end
  end
  return sum
end

-- place: p, q, and how they move to the right and down.
local function sample_picture(axis, levels, u, v, right, down)
  local whole, wrap, filter = levels[1], axis.wrap, axis.filter
  local function is_in(at, size) return at >= -1e-6 and at < size - 1e-6 end
  if wrap == 0 and not (is_in(u, whole.width) and is_in(v, whole.height)) then
    return {0, 0, 0, 0}
  end
  local ux, vx = math.abs(right[1]), math.abs(right[2])
  local uy, vy = math.abs(down[1]), math.abs(down[2])
  local is_flat = axis.w[1] == 0 and axis.w[2] == 0 and axis.w[3] == 1
  local most = 1 + 1e-6
  local is_enlarged = ux + uy <= most and vx + vy <= most
    or is_flat and ux ^ 2 + vx ^ 2 <= most and uy ^ 2 + vy ^ 2 <= most
  local x, y = reduce(wrap, u, whole.width), reduce(wrap, v, whole.height)
  if filter == 1 then
    return texel_of(whole, wrap, math.floor(x + 1e-6), math.floor(y + 1e-6))
  elseif filter == 3 and is_enlarged then
    return mix_texels(whole, wrap, cubic_of(x), cubic_of(y))
  elseif filter == 2 or is_enlarged then
    return sample_linear(whole, levels, wrap, u, v)
  elseif is_flat and math.min(ux + vy, vx + uy) <= 1e-12 * math.max(ux + vy, vx + uy) then
    return sample_box(levels, wrap, u, v, ux + uy, vx + vy)
  end
  return sample_taps(levels, wrap, u, v, right, down)
end

---------------------------------------------------------------------- programs

local function find_place(axis, x, y)
  local function value(plane) return plane[1] * x + plane[2] * y + plane[3] end
  local w = value(axis.w)
  local p, q = value(axis.p) / w, value(axis.q) / w
  if axis.kind == 1 then p = math.sqrt(p * p + q * q) - p * axis.focus end
  return w > 0 and p == p and q == q, p, q
end

local function show_picture(step, x, y, p, q, size)
  local axis, right, down = step.axis, {}, {}
  local w = axis.w[1] * x + axis.w[2] * y + axis.w[3]
  for i, plane in ipairs {axis.p, axis.q} do
    local at = i == 1 and p or q
    right[i] = (plane[1] - at * axis.w[1]) / size.columns / w
    down[i] = (plane[2] - at * axis.w[2]) / size.rows / w
  end
  local shown, out = sample_picture(axis, axis.levels, p, q, right, down), {}
  for c = 1, 4 do out[c] = shown[c] * step[1].colour[c] / 65535 end
  return out
end

local function find_colour(step, x, y, size)
  local exists, p, q = find_place(step.axis, x, y)
  if not exists then return {0, 0, 0, 0} end
  local out, count = {}, #step
  if step.axis.kind == 3 then return show_picture(step, x, y, p, q, size) end
  if step.axis.kind == 2 then
    for c = 4, 1, -1 do
      local s = step[1].colour[c]
      local value = s + p * (step[2].colour[c] - s) + q * (step[3].colour[c] - s)
      out[c] = math.max(0, math.min(c == 4 and 65535 or out[4], value))
    end
    return out
  end
  if p < step[1].at then return step[1].colour end
  for i = 1, count - 1 do
    local from, to = step[i], step[i + 1]
    if p >= from.at and p < to.at then
      local share = (p - from.at) / (to.at - from.at)
      for c = 1, 4 do out[c] = from.colour[c] + share * (to.colour[c] - from.colour[c]) end
      return out
    end
  end
  return step[count].colour
end

local function leave(step, layer)
  for c = 1, 3 do
    local s = math.max(layer[4], math.min(65535, math.abs(layer[c])))
    if step.how == 1 and s > 0 then layer[c] = s * decode(layer[c] / s) end
  end
  for c = 1, 4 do layer[c] = layer[c] * step.factors[c] / 65535 end
end

-- A group that was left becomes a veil: by what the layers behind it are multiplied.
local function add_veil(how, layer, front)
  local r, g, b, a = layer[1] / 65535, layer[2] / 65535, layer[3] / 65535, layer[4] / 65535
  local function clamp(x) return math.max(0, math.min(1, x)) end
  local matte = how >= 7 and clamp(0.2126 * r + 0.7152 * g + 0.0722 * b) or clamp(a)
  if how == 6 or how == 8 then matte = 1 - matte end
  local veil, before = front.veil, 0
  for c = 1, 3 do before = before + veil[c] / 3 end
  for c, x in ipairs {r, g, b, 0} do
    local by = how >= 5 and matte or c == 4 and 1 or how == 3 and x or how == 4 and 1 - x
      or 1 - clamp(a) + x
    veil[c] = veil[c] * by
  end
  if how ~= 2 then return end
  local mean = (veil[1] + veil[2] + veil[3]) / 3 / before
  mean = mean > 0 and mean or 0
  for c = 1, 3 do veil[c] = mean > 0 and veil[c] / mean or 0 end
  front[4] = 65535 - (65535 - front[4]) * mean
end

local function new_group() return {0, 0, 0, 0, veil = {1, 1, 1, 1}} end

local function show(program, x, y, size)
  local groups = {new_group()}
  for _, step in ipairs(program) do
    local layer
    if step.kind == 2 then
      groups[#groups + 1] = new_group()
    elseif step.kind == 3 then
      layer = table.remove(groups)
      leave(step, layer)
    else
      layer = step.kind == 0 and step.colour or find_colour(step, x, y, size)
    end
    local front = groups[#groups]
    if step.kind == 3 and step.how > 1 then
      add_veil(step.how, layer, front)
      layer = nil
    end
    local through = 1 - front[4] / 65535
    for c = 1, layer and 4 or 0 do front[c] = front[c] + through * front.veil[c] * layer[c] end
  end
  return groups[1]
end

---------------------------------------------------------------------- drawing

local function point_at(piece, t)
  local level = {}
  for i, p in ipairs(piece) do level[i] = {p[1] * p[3], p[2] * p[3], p[3]} end
  for last = #level - 1, 1, -1 do
    for i = 1, last do
      for k = 1, 3 do level[i][k] = level[i][k] * (1 - t) + level[i + 1][k] * t end
    end
  end
  return level[1][1] / level[1][3], level[1][2] / level[1][3]
end

-- What is left of `edge` on a line from x = a to b: 0..1.
local function share_left(a, b, edge)
  local low, high = edge - math.max(a, b), edge - math.min(a, b)
  local function integral(u) return u <= 0 and 0 or u >= 1 and u - 0.5 or u * u / 2 end
  if high - low < 1e-6 then return math.max(0, math.min(1, low)) end
  return (integral(high) - integral(low)) / (high - low)
end

-- The area of a pixel right of a border changes the shares of cells.
local function add_shares(shares, border, x, area)
  for sign, cell in pairs {[-1] = border.left, [1] = border.right} do
    if cell.program then
      shares[cell] = shares[cell] or {}
      shares[cell][x] = (shares[cell][x] or 0) + sign * area
    end
  end
end

-- A line down from (xa, ya) to (xb, yb), in pixels, adds to the rows that it crosses.
local function add_line(rows, columns, xa, ya, xb, yb, border)
  local y = ya
  while y < yb do
    local row = math.floor(y)
    local foot, slope = math.min(row + 1, yb), (xb - xa) / (yb - ya)
    local a, b, before = xa + (y - ya) * slope, xa + (foot - ya) * slope, 0
    for x = 0, columns - 1 do
      local share = share_left(a, b, x + 1) * (foot - y)
      for c = 1, 4 do
        rows[row][4 * x + c] = rows[row][4 * x + c] + border.change[c] * (share - before)
      end
      add_shares(rows[row].shares, border, x, share - before)
      before = share
    end
    y = foot
  end
end

local function draw_border(rows, size, border)
  local fit, STEPS = {x = size.columns / SIDE, y = size.rows / SIDE}, 40
  for _, piece in ipairs(border.chain) do
    local steps = #piece == 2 and 1 or STEPS
    local xa, ya = piece[1][1], piece[1][2]
    for i = 1, steps do
      local xb, yb = point_at(piece, i / steps)
      local top, foot = math.max(ya, border.top), math.min(yb, border.foot)
      if top < foot then
        local slope = (xb - xa) / (yb - ya)
        add_line(rows, size.columns, (xa + (top - ya) * slope) * fit.x, top * fit.y,
          (xa + (foot - ya) * slope) * fit.x, foot * fit.y, border)
      end
      xa, ya = xb, yb
    end
  end
end

---------------------------------------------------------------------- the file

local function payload_at(bytes, offset)
  local length = ("<I4"):unpack(bytes, offset + 2)
  local record = bytes:sub(offset + 1, offset + 5 + length)
  assert(crc32c(("<I8"):pack(offset) .. record) == ("<I4"):unpack(bytes, offset + 6 + length))
  return record:sub(6), record:sub(1, 1)
end

-- The offsets of the pictures that an index begins with, and the entries after them.
local function split_index(index, flags)
  local offsets = {}
  if flags & 16 == 0 then return offsets, index end
  local count = ("<I4"):unpack(index)
  for i = 1, count do offsets[i] = ("<I8"):unpack(index, 8 * i - 3) end
  return offsets, index:sub(5 + 8 * count)
end

-- The parts of the index of a frame, its flags, and the entries of its base or nil.
local function read_index(bytes, frame)
  assert(bytes:sub(1, 8) == "celplane" and crc32c(bytes:sub(1, 36)) == ("<I4"):unpack(bytes, 37))
  local trailer, flags = bytes:sub(-32), ("<I4"):unpack(bytes, 13)
  local last, size = ("<I8I8"):unpack(trailer, 9)
  assert(trailer:sub(1, 8) == "planeend" and size == #bytes)
  if flags ~= 4 then
    local offsets, entries = split_index(payload_at(bytes, last), flags)
    return offsets, entries, flags
  end
  local index = payload_at(bytes, (("<I8"):unpack(payload_at(bytes, last), 9 + 8 * frame)))
  local own, base = ("<I4I8"):unpack(index)
  local offsets, entries = split_index(index:sub(13), own)
  if base == 0 then return offsets, entries, own end
  local other = payload_at(bytes, base)
  local _, base_entries = split_index(other:sub(13), (("<I4"):unpack(other)))
  return offsets, entries, own, base_entries
end

-- The pictures that the axes of bands lie on.
local function find_pictures(bytes, bands, offsets, host)
  local pictures = {}
  for _, band in ipairs(bands) do
    for _, axis in ipairs(band.axes) do
      local number = axis.kind == 3 and axis.picture + 1
      if number then
        pictures[number] = pictures[number]
          or read_picture(payload_at(bytes, offsets[number]), host)
        axis.levels = pictures[number]
      end
    end
  end
end

-- The grid of a file: the step next to a coordinate of axis 1, x, or 2, y, and a coordinate that is
-- moved by some steps.
local function new_grid(columns, rows)
  local grid, steps = {}, {}
  for axis, count in ipairs {columns, rows} do steps[axis] = count > 0 and 100 * count or SIDE end
  function grid.step(at, axis) return (at * steps[axis] + SIDE // 2) // SIDE end
  function grid.move(at, by, axis)
    return ((grid.step(at, axis) + by) * SIDE + steps[axis] // 2) // steps[axis]
  end
  return grid
end

-- bands: all that the index names, in order.
local function read_bands(bytes, frame, host)
  local offsets, entries, flags, base_entries = read_index(bytes, frame)
  local bands, grid = {}, new_grid(("<I2I2"):unpack(bytes, 33))
  for at = 1, #entries, 12 do
    local payload, kind = payload_at(bytes, (("<I8"):unpack(entries, at + 4)))
    local base = kind == "D" and payload_at(bytes, (("<I8"):unpack(base_entries, at + 4))) or nil
    bands[#bands + 1] = read_band(payload, flags, grid, base and read_band(base, flags, grid))
  end
  find_pictures(bytes, bands, offsets, host)
  return bands, flags & 1 > 0
end

local function add_programs(row, y, size, is_opaque)
  for cell, changes in pairs(row.shares) do
    local share = 0
    for x = 0, size.columns - 1 do
      share = share + (changes[x] or 0)
      if math.abs(share) > 1e-9 then
        local colour = show(cell.program, (x + 0.5) / size.columns, (y + 0.5) / size.rows, size)
        for c = 1, 4 do row[4 * x + c] = row[4 * x + c] + share * colour[c] end
        row[4 * x + 4] = is_opaque and 65535 or row[4 * x + 4]
      end
    end
  end
end

-- Returns rows 0 to rows - 1 of a frame, from 0, each an array of four numbers a pixel, with 65535
-- for white. host: gives the codes of a picture, four bytes a pixel, by its name, size and key.
return function(bytes, columns, row_count, frame, host)
  local rows, size = {}, {columns = columns, rows = row_count}
  local bands, is_opaque = read_bands(bytes, frame or 0, host)
  for y = 0, row_count - 1 do
    rows[y] = {shares = {}}
    for i = 1, 4 * columns do rows[y][i] = 0 end
  end
  for _, band in ipairs(bands) do
    for _, border in ipairs(band.borders) do draw_border(rows, size, border) end
  end
  for y = 0, row_count - 1 do
    local sum = {table.unpack(bands[1].cells[1])}
    for i = 1, 4 * columns do
      local c = (i - 1) % 4 + 1
      sum[c] = sum[c] + rows[y][i]
      rows[y][i] = sum[c]
    end
    add_programs(rows[y], y, size, is_opaque)
  end
  return rows
end
