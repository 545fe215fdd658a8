--- A film in a workbench, for tests of jobs: commands in its folder, and what they made.
---
---   before_each(function() bench = farm.begin() end)
---   after_each(farm.finish)
local assert = require "luassert"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local farm = {}

--- Seven frames, from number 3 on, that differ; an argument of the script is the radius of a disc.
farm.FILM = [[
local celspan = require "celspan"
local radius = tonumber((...)) or 20
return celspan.film { size = { 60, 40 }, frames = 7, first = 3, frame = function(f)
  return celspan.rostrum { celspan.cel { celspan.circle { centre = { 5 * f.number, 20 },
    radius = radius, texture = "#c04030" } } }
end }
]]

farm.word = system.quote

local bench

--- Returns a new workbench with the film in film.lua.
function farm.begin()
  bench = workbench.new()
  bench:write("film.lua", farm.FILM)
  return bench
end

function farm.finish() bench:remove() end

--- Runs a command in the folder of the bench, where CELSPAN is the program that is tested.
function farm.shell(command)
  return bench:inside(("CELSPAN=%s && export CELSPAN && %s"):format(farm.word(workbench.absolute),
    command))
end

function farm.celspan(arguments) return farm.shell('"$CELSPAN" ' .. arguments) end

--- Runs celspan, which must succeed. Returns what it printed.
function farm.done(arguments)
  local code, out, err = farm.celspan(arguments)
  assert.equal(0, code, err)
  return out
end

--- Runs celspan, which must refuse its arguments with this text.
function farm.refused(text, arguments)
  local code, out, err = farm.celspan(arguments)
  assert.equal(2, code, err)
  assert.equal("", out)
  assert.is_truthy(err:find(text, 1, true), err)
end

--- The files of frames, without records.
function farm.frames_in(folder)
  local _, names = bench:shell("ls " .. farm.word(bench.folder .. "/" .. folder))
  return (names:gsub("\n$", ""):gsub("\n", " "))
end

function farm.same(a, b) assert.equal(bench:read(a), bench:read(b), a .. " is not " .. b) end

return farm
