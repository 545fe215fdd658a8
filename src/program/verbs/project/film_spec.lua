-- What the film must show, whatever else is changed. Run by `celspan test`.
require "celspan.spec"
local film = require "film"

describe("@NAME@", function()
  it("shows its walker on every frame", function()
    for n = 1, film.frames, 6 do
      assert.cel(film, n, "walker").is_visible()
    end
  end)

  it("keeps the walker small before a wide sky", function()
    assert.cel(film, 1, "walker").is_not.covers(0.1)
    assert.cel(film, 1, "sky").covers(1)
  end)

  it("has the sun where it was put", function()
    assert.point(film, 1, 500, 92).shows "#fff3cf"
    assert.point(film, 30, 500, 92).shows "#fff3cf"
  end)

  it("moves", function()
    assert.frames(film, 1, 9).is_not.look_alike()
  end)

  it("looks like its first frame, as it was accepted", function()
    assert.frame(film, 1).looks_like("frame1.png", { tolerance = 0.02 })
  end)
end)
