-- Tests for things that the film must show after every change. Run by `celspan test`.
require "celspan.spec"
local film = require "film"
local when = require "timing"

local function frame_of(seconds) return math.floor(film.fps * seconds) + 1 end

describe("@NAME@", function()
  it("shows its cat and the star on every frame", function()
    for n = 1, film.frames, 40 do
      assert.cel(film, n, "cat").is_visible()
      assert.cel(film, n, "star").is_visible()
    end
  end)

  it("lights the windows only after the star is caught", function()
    assert.cel(film, frame_of(when.catch), "windows").is_not.visible()
    assert.cel(film, film.frames, "windows").is_visible()
  end)

  it("has a cat in its coat where it sits first", function()
    assert.point(film, 1, 200, 430).shows "#171130"
    assert.point(film, film.frames, 200, 430).is_not.shows "#171130"
  end)

  it("draws the cat on twos, and moves the star on every frame", function()
    assert.frames(film, 13, 14).is_not.look_alike()
    assert.frames(film, 13, 15).is_not.look_alike()
  end)
end)
