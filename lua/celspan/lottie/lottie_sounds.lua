--- The sounds of an animation as a list for a film: also those of compositions, each time that one
--- is shown.
--
--   clock   start + rate * (a frame of the composition) = a frame of the animation
--           from, to: the frames of the animation in which the composition is shown
local values = require "celspan.lottie_values"

local sounds = {}

local MOST = 1000
local SLOWEST, FASTEST = 0.01, 100 -- of the speed of a film's sound

--- The layers of the composition that a layer shows, and their scope.
local function inside(root, item)
  local asset = item.ty == 0 and item.refId ~= nil and root.assets[item.refId]
  if asset and values.table(asset.item.layers) then return asset end
end

--- Whether there are sounds in a list of layers.
local function has_sounds(root, list)
  for _, one in ipairs(values.items(list)) do
    if one[2].ty == 6 then return true end
    local asset = inside(root, one[2])
    if asset and asset.has_sounds == nil then
      asset.has_sounds = false -- of a composition in itself
      asset.has_sounds = has_sounds(root, asset.item.layers)
    end
    if asset and asset.has_sounds then return true end
  end
  return false
end

--- The clock of a layer's contents; nil: it is not shown, or runs at no speed that a sound has.
local function clock_of(clock, item, scope)
  local first, last = values.number(item.ip, 0), values.number(item.op, 1e7)
  local inner = { start = clock.start + clock.rate * values.number(item.st, 0),
                  rate = clock.rate * values.number(item.sr, 1),
                  from = math.max(clock.from, clock.start + clock.rate * first),
                  to = math.min(clock.to, clock.start + clock.rate * last) }
  if inner.from >= inner.to then return nil end
  if values.table(item.tm) then
    scope.note "its time is remapped; its sounds are left out"
    return nil
  end
  if inner.rate >= 1 / FASTEST and inner.rate <= 1 / SLOWEST then return inner end
  scope.note(("its sounds run at %.3g times their speed, which must be from %g to %g; they are "
    .. "left out"):format(1 / inner.rate, SLOWEST, FASTEST))
end

--- Adds the sound of a layer.
local function add(root, item, scope, clock)
  local path, message = root.sound_file(item.refId)
  if #root.sounds >= MOST then
    path, message = nil, ("there are more than %d sounds; the others are left out"):format(MOST)
  end
  if not path then
    scope.note(message)
    return
  end
  if values.table(item.au) then
    scope.note "its level is left out; the sound is as loud as its file"
  end
  local from, speed = math.max(clock.from, clock.start), 1 / clock.rate
  if from >= clock.to then return end
  local function second(frame) return (frame - clock.start) * speed / root.fps end
  root.sounds[#root.sounds + 1] = { path, at = (from - root.first) / root.fps, from = second(from),
    to = second(clock.to), speed = speed ~= 1 and speed or nil }
end

local function walk(root, list, scope, clock)
  for _, one in ipairs(values.items(list)) do
    local item = one[2]
    local asset = inside(root, item)
    local has = item.ty == 6 or asset and not asset.is_heard and has_sounds(root, { item })
    if has and not values.flag(item.hd) then
      local own = scope.within(("[%d]"):format(one[1] - 1), item.nm)
      local inner = clock_of(clock, item, own)
      if inner and asset then
        asset.is_heard = true
        walk(root, asset.item.layers, asset.scope.within ".layers", inner)
        asset.is_heard = nil
      elseif inner then
        add(root, item, own, inner)
      end
    end
  end
end

--- Collects the sounds of the whole in root.sounds.
function sounds.collect(root, list)
  if not has_sounds(root, list) then return end
  walk(root, list, root.scope.within "layers",
    { start = 0, rate = 1, from = root.first, to = root.last })
end

return require "celspan.fields".seal("lottie_sounds", sounds)
