--- The forms of a shape layer - paths, rectangles, ellipses, stars - as functions of the frame that
--- return outlines.
local contours = require "celspan.lottie_contour"
local curves = require "celspan.curves"
local property = require "celspan.lottie_property"

local forms = {}

local function directed(list, item)
  if #list == 0 then return {} end
  return { item.d == 3 and curves.reversed(list) or list }
end

local kinds = {}

function kinds.sh(scope, item)
  local outline, moves = property.outline(scope, item.ks, "the path", item.closed == true)
  return function(t) return directed(outline(t), item) end, moves
end

function kinds.rc(scope, item)
  local read, moves = property.reader(scope)
  local position = read(property.point, item.p, "the position")
  local size = read(property.list, item.s, "the size", { 0, 0 })
  local radius = read(property.number, item.r, "the roundness", 0)
  return function(t)
    local p, s = position(t), size(t)
    return directed(contours.rectangle(p[1], p[2], s[1], s[2], radius(t)), item)
  end, moves()
end

function kinds.el(scope, item)
  local read, moves = property.reader(scope)
  local position = read(property.point, item.p, "the position")
  local size = read(property.list, item.s, "the size", { 0, 0 })
  return function(t)
    local p, s = position(t), size(t)
    return directed(contours.ellipse(p[1], p[2], s[1] / 2, s[2] / 2), item)
  end, moves()
end

function kinds.sr(scope, item)
  local read, moves = property.reader(scope)
  local position = read(property.point, item.p, "the position")
  local points = read(property.number, item.pt, "the points", 5)
  local turn = read(property.number, item.r, "the rotation", 0)
  local outer = read(property.number, item["or"], "the outer radius", 0)
  local outer_round = read(property.number, item.os, "the outer roundness", 0)
  local inner = read(property.number, item.ir, "the inner radius", 0)
  local inner_round = read(property.number, item.is, "the inner roundness", 0)
  return function(t)
    local p = position(t)
    return directed(contours.star(p[1], p[2], points(t), turn(t),
      { outer(t), outer_round(t) / 100 },
      item.sy ~= 2 and { inner(t), inner_round(t) / 100 } or nil), item)
  end, moves()
end

--- The outlines of an item; nil for an item of another kind.
---@return (fun(t: number): table[])? get
---@return boolean? moves
function forms.read(scope, item)
  local read = kinds[item.ty]
  if read then return read(scope, item) end
end

return require "celspan.fields".seal("lottie_forms", forms)
