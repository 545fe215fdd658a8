-- The town with a hundred windows: a winter night in which an old man lights the street, and behind
-- each window somebody is awake. `./run docs` makes the page in which one goes into the rooms.
local scene = require "town.scene"

local set = parameters { part = { "all", "still", "lights", "street", "air", "snow" } }

local INK = require("stage.moods").storm.ink
local seconds = { all = 12, still = 1 / 12, lights = 12, street = 12, air = 2, snow = 2 }
local has_ground = set.part == "all" or set.part == "still"

return film { title = "The town with a hundred windows", size = { 1920, 1080 }, fps = 12,
  duration = seconds[set.part], background = has_ground and INK or nil,
  poster = set.part == "all" and "8s" or nil,
  frame = function(f) return cel(scene[set.part](f)) end }
