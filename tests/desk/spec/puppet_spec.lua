-- Puppets: bones, poses and targets, and the motion that follows others. One list of cases, as long
-- as the options of a puppet.
local celspan = require "celspan"
local layers = require "celspan.layers"
local motion = require "celspan.motion"
local paintings = require "tests.support.paintings"
local particles = require "celspan.particles"
local present = require "tests.support.present"
local prng = require "tests.support.prng"
local puppet = require "celspan.puppet"
local raised = require "tests.support.raised"
local reach = require "tests.support.own" "celspan.reach"
local svg = require "celspan.svg"
local workbench = require "tests.support.workbench"

local bench = workbench.new()
local with_art = present.type and it or pending

-- ---------------------------------------------------------------- chains

--- The end of a chain, from the definition.
local function end_of(bones, angles)
  local x, y, sum = 0, 0, 0
  for k, bone in ipairs(bones) do
    sum = sum + angles[k]
    x = x + math.cos(sum) * bone[1] - math.sin(sum) * bone[2]
    y = y + math.sin(sum) * bone[1] + math.cos(sum) * bone[2]
  end
  return x, y
end

local function random_bones(random, count, has_limits)
  local bones = {}
  for k = 1, count do
    local low = has_limits and random:between(-3, 1) or -7
    bones[k] = { random:between(-3, 3), random:between(-3, 3), low,
                 has_limits and low + random:between(0, 3) or 7, 0 }
  end
  return bones
end

local function random_angles(random, bones)
  local angles = {}
  for k, bone in ipairs(bones) do angles[k] = random:between(bone[3], bone[4]) end
  return angles
end

local function is_within(bones, angles)
  for k, bone in ipairs(bones) do
    if angles[k] < bone[3] or angles[k] > bone[4] then return false end
  end
  return true
end

describe("a chain of bones", function()
  it("of two reaches every target that it can reach, within 1e-9", function()
    local random, worst = prng.new(1), 0
    for i = 1, 10000 do
      local bones = random_bones(random, 2, i % 2 == 0)
      local target = { end_of(bones, random_angles(random, bones)) }
      local angles, distance = reach.solve { bones = bones, target = target }
      assert.is_true(is_within(bones, angles))
      local x, y = end_of(bones, angles)
      assert.is_true(math.abs(math.sqrt((x - target[1]) ^ 2 + (y - target[2]) ^ 2) - distance)
        < 1e-12)
      worst = math.max(worst, distance)
    end
    assert.is_true(worst < 1e-9, worst)
  end)

  it("of two is nowhere nearer than its answer, within limits and out of reach", function()
    local random, steps, is_nearest = prng.new(2), 24, true
    for _ = 1, 400 do
      local bones = random_bones(random, 2, true)
      local target = { random:between(-8, 8), random:between(-8, 8) }
      local _, distance = reach.solve { bones = bones, target = target }
      for i = 0, steps do
        for j = 0, steps do
          local x, y = end_of(bones, { bones[1][3] + (bones[1][4] - bones[1][3]) * i / steps,
                                       bones[2][3] + (bones[2][4] - bones[2][3]) * j / steps })
          local other = math.sqrt((x - target[1]) ^ 2 + (y - target[2]) ^ 2)
          is_nearest = is_nearest and other > distance - 1e-9
        end
      end
    end
    assert.is_true(is_nearest)
  end)

  it("of three to eight reaches its targets within 1e-6 and keeps its limits", function()
    local random, worst = prng.new(3), 0
    for i = 1, 1500 do
      local bones = random_bones(random, 3 + i % 6, true)
      local target = { end_of(bones, random_angles(random, bones)) }
      local angles, distance = reach.solve { bones = bones, target = target }
      assert.is_true(is_within(bones, angles))
      worst = math.max(worst, distance)
    end
    assert.is_true(worst < 1e-6, worst)
  end)

  it("of two that is drawn straight bends to the side where it may bend farther", function()
    local function bend(low, high, y)
      return reach.solve { target = { 100, 50 },
        bones = { { 100, 0, -9, 9, 0 }, { 100, y or 0, low, high, 0 } } }[2]
    end
    assert.is_true(bend(-2, 2.5) > 0)
    assert.is_true(bend(-2.5, 2) < 0)
    assert.is_true(bend(-2, 2.5, -1e-8) > 0) -- straight, except for rounding
    assert.is_true(bend(-2, 2.5, -1e-3) < 0)
  end)

  it("that cannot reach lies straight towards its target", function()
    for count = 1, 6 do
      local bones = {}
      for k = 1, count do bones[k] = { 1, 0.5 * k, -7, 7, 0.3 } end
      local angles = reach.solve { bones = bones, target = { 300, 400 } }
      local x, y = end_of(bones, angles)
      assert.is_true(math.abs(x * 4 - y * 3) < 1e-9 * math.sqrt(x * x + y * y) and x > 0)
    end
  end)

  it("bends to the side of the drawing, or of a pole", function()
    local function cross(chain)
      local angles = reach.solve(chain)
      return math.sin(angles[2])
    end
    for _, side in ipairs { 1, -1 } do
      local bones = { { 10, side, -7, 7, 0 }, { 10, side * 3, -7, 7, 0 } }
      local first = math.atan(1, 10)
      local bend = cross { bones = { { 10, 0, -7, 7, 0 }, { 10, side, -7, 7, 0 } },
                           target = { 12, 0 } }
      assert.is_true(bend * side > 0 and first > 0)
      bend = cross { bones = bones, target = { 12, 0 }, pole = { 6, 50 } }
      assert.is_true(bend < 0)
      bend = cross { bones = bones, target = { 12, 0 }, pole = { 6, -50 } }
      assert.is_true(bend > 0)
    end
  end)
end)

-- ---------------------------------------------------------------- puppets

local FIGURE = [[
<svg xmlns="http://www.w3.org/2000/svg" width="100" height="100">
<rect id="body" x="40" y="0" width="20" height="40" fill="#f00"/>
<g id="thigh"><rect id="thigh shape" x="45" y="36" width="10" height="28" fill="#0f0"/>
<rect id="shin" x="46" y="58" width="8" height="26" fill="#00f"/></g>
<rect id="mouth A" x="44" y="4" width="4" height="4" fill="#fff"/>
<rect id="mouth B" x="52" y="4" width="4" height="4" fill="#fff"/>
<circle id="joint hip" cx="50" cy="40" r="2"/><circle id="joint knee" cx="50" cy="60" r="2"/>
<circle id="joint ankle" cx="50" cy="80" r="2"/></svg>]]

local function figure()
  return assert(svg.read(bench:write("figure.svg", FIGURE)))
end

local function rig_of(settings)
  local given = { art = figure(), bones = { { "thigh", from = "hip", to = "knee" },
    { "shin", from = "knee", to = "ankle" } }, switches = { "mouth" } }
  for name, value in pairs(settings or {}) do given[name] = value end
  return puppet(given)
end

--- Which of red, green, blue and white is at a point; "none" where nothing is.
local function colour_at(object, x, y)
  local r, g, b, alpha = celspan.probe(celspan.rostrum { celspan.cel { object } }, x, y,
    { film = { 100, 100 } })
  if alpha < 0.5 then return "none" end
  return r > 0.5 and b > 0.5 and "white" or r > 0.5 and "red" or g > 0.5 and "green"
    or b > 0.5 and "blue" or "black"
end

local function near(x, y, x1, y1, within)
  assert.is_true(math.abs(x - x1) < (within or 1e-9) and math.abs(y - y1) < (within or 1e-9),
    ("%.14g, %.14g instead of %.14g, %.14g"):format(x, y, x1, y1))
end

describe("a puppet", function()
  with_art("at rest is its drawing, without the joints and with the first of each switch",
    function()
      local object = rig_of():pose {}
      assert.equal("green", colour_at(object, 50, 50))
      assert.equal("blue", colour_at(object, 50, 80))
      assert.equal("white", colour_at(object, 46, 6))
      assert.equal("red", colour_at(object, 54, 6))
    end)

  with_art("turns a bone with everything below it, also parts inside of others", function()
    local rig = rig_of()
    local object = rig:pose { thigh = -90, mouth = "B" }
    assert.equal("green", colour_at(object, 60, 40))
    assert.equal("blue", colour_at(object, 80, 40))
    assert.equal("none", colour_at(object, 50, 62))
    assert.equal("white", colour_at(object, 54, 6))
    near(70, 40, rig:joint({ thigh = -90 }, "knee"))
    object = rig:pose { thigh = -90, shin = 90, at = { 10, 5 } }
    assert.equal("blue", colour_at(object, 80, 60))
    local x, y = rig:joint({ thigh = -90, shin = 90, at = { 10, 5 } }, "ankle")
    near(80, 65, x, y)
  end)

  with_art("notices when a pose is changed after it was asked for a joint", function()
    local rig, pose = rig_of(), { thigh = -90, reach = {} }
    near(70, 40, rig:joint(pose, "knee"))
    pose.thigh = 0
    near(50, 60, rig:joint(pose, "knee"))
    pose.thigh, pose.reach.ankle = nil, { 65, 60 }
    near(65, 60, rig:joint(pose, "ankle"))
    pose.reach.ankle[2] = 55
    near(65, 55, rig:joint(pose, "ankle"))
    pose.at = { 3, 4 }
    near(53, 44, rig:joint(pose, "hip"))
    pose.at[1] = 7
    near(57, 44, rig:joint(pose, "hip"))
  end)

  with_art("places a bone once in a pose, and only for a joint that hangs on it", function()
    local rig = rig_of { joints = { hand = { 80, 40 } }, bones = {
      { "thigh", from = "hip", to = "knee" }, { "shin", from = "knee", to = "ankle" },
      { "arm", from = "hip", to = "hand", parts = {} } } }
    local solve, calls = reach.solve, 0
    reach.solve = function(chain)
      calls = calls + 1
      return solve(chain)
    end
    local pose = { arm = 90, reach = { ankle = { 65, 60 } } }
    local x, y = rig:joint(pose, "hand")
    local before = calls
    rig:joint(pose, "ankle")
    rig:pose(pose)
    reach.solve = solve
    near(50, 70, x, y)
    assert.same({ 0, 1 }, { before, calls })
  end)

  with_art("stretches a bone, and moves what hangs on it without changing its shape", function()
    local rig = rig_of()
    local object = rig:pose { thigh = { stretch = 1.5 } }
    near(50, 70, rig:joint({ thigh = { stretch = 1.5 } }, "knee"))
    near(50, 90, rig:joint({ thigh = { scale = 1.5 } }, "ankle"))
    assert.equal("none", colour_at(object, 54, 55)) -- narrower: 10 / 1.5 wide
    assert.equal("green", colour_at(object, 53, 55))
    assert.equal("blue", colour_at(object, 53.5, 85)) -- the shin is as wide as before
  end)

  with_art("takes an angle of the drawing instead of one from the parent", function()
    local x, y = rig_of():joint({ thigh = -37, shin = { absolute = 0 } }, "ankle")
    local kx, ky = rig_of():joint({ thigh = -37 }, "knee")
    near(kx, ky + 20, x, y)
  end)

  with_art("reaches for a point, within its limits, and lengthens itself where that is allowed",
    function()
      local rig = rig_of()
      for _, point in ipairs { { 65, 60 }, { 50, 50 }, { 20, 45 } } do
        near(point[1], point[2], rig:joint({ reach = { ankle = point } }, "ankle"))
      end
      local pose = { at = { 7, 3 }, reach = { ankle = { 60, 70 } } }
      near(60, 70, rig:joint(pose, "ankle"))
      near(90, 40, rig:joint({ reach = { ankle = { 150, 40 } } }, "ankle"))
      near(150, 40, rig:joint({ reach = { ankle = { 150, 40, stretch = true } } }, "ankle"))
      local stiff = rig_of { bones = { { "thigh", from = "hip", to = "knee", limits = { -30, 30 } },
        { "shin", from = "knee", to = "ankle", limits = { 0, 90 } } } }
      local hx = stiff:joint({ reach = { ankle = { 150, 40 } } }, "knee")
      assert.is_true(math.abs(hx - (50 + 20 * math.sin(math.rad(30)))) < 1e-9)
    end)

  with_art("draws parts over, under, in front and behind, where a pose says so", function()
    local rig = rig_of { bones = { { "body", from = "hip", to = "knee" },
      { "thigh", from = "hip", to = "knee" },
      { "shin", from = "knee", to = "ankle", parent = "thigh" } } }
    assert.equal("green", colour_at(rig:pose {}, 50, 38))
    assert.equal("red", colour_at(rig:pose { under = { thigh = "body" } }, 50, 38))
    assert.equal("red", colour_at(rig:pose { over = { body = "thigh" } }, 50, 38))
    assert.equal("blue", colour_at(rig:pose {}, 50, 60))
    assert.equal("green", colour_at(rig:pose { back = { "shin" } }, 50, 60))
    assert.equal("blue", colour_at(rig:pose { back = { "shin" } }, 50, 70))
    assert.equal("red", colour_at(rig:pose { front = { "body" } }, 46, 6))
    -- a part inside of one that moves is drawn elsewhere at its own place
    assert.equal("blue", colour_at(rig:pose { thigh = -90, front = { "shin" } }, 80, 40))
  end)

  with_art("says where its limbs come apart", function()
    local rig = rig_of()
    assert.are.same({}, rig:gaps())
    assert.are.same({}, rig:gaps { shin = 60 })
    local torn = rig_of { joints = { knee = { 50, 70 } } }
    local gaps = torn:gaps()
    assert.equal(1, #gaps)
    assert.equal("shin", gaps[1].bone)
    assert.equal("knee", gaps[1].joint)
  end)

  with_art("has limbs that come apart reported by check, unless they may", function()
    figure()
    local function check(apart)
      bench:write("apart.lua", ([[local celspan = require "celspan"
local rig = require "celspan.puppet" { art = assert(require "celspan.svg".read "figure.svg"),
  joints = { knee = { 50, 70 } }, bones = { { "thigh", from = "hip", to = "knee" },
    { "shin", from = "knee", to = "ankle", apart = %s } } }
return celspan.film { size = { 100, 100 }, frames = 3, frame = function(f)
  return celspan.rostrum { celspan.cel { rig:pose { at = { 0, 5 * f.index } } } } end }]])
        :format(apart))
      local code, _, err = bench:celspan_inside "check apart.lua"
      return code, err
    end
    local code, err = check(false)
    assert.equal(3, code)
    assert.equal("celspan: error: frames 1-3: apart.lua:6: puppet: 'shin' and 'thigh' come apart "
      .. "at the joint 'knee': let the drawings of both cover it, or give the bone apart = true\n"
      .. "celspan: 1 fault, found 3 times in 3 frames\n", err)
    assert.equal(0, (check(true)))
  end)

  with_art("has targets that are out of reach reported by check, unless they may be", function()
    figure()
    local function check(target)
      bench:write("far.lua", ([[local celspan = require "celspan"
local rig = require "celspan.puppet" { art = assert(require "celspan.svg".read "figure.svg"),
  bones = { { "thigh", from = "hip", to = "knee" }, { "shin", from = "knee", to = "ankle" } } }
return celspan.film { size = { 100, 100 }, frames = 1, frame = function()
  return celspan.rostrum { celspan.cel { rig:pose { reach = { ankle = %s } } } } end }]])
        :format(target))
      return (select(3, bench:celspan_inside "check far.lua"))
    end
    assert.truthy(check("{ 50, 81 }"):find("frame 1: far.lua:5: puppet: the joint 'ankle' does not "
      .. "reach its target", 1, true))
    for _, target in ipairs { "{ 50, 79 }", "{ 50, 80.3 }", "{ 50, 99, loose = true }",
                              "{ 50, 99, stretch = true }" } do
      assert.truthy(check(target):find("no faults", 1, true), target)
    end
  end)

  with_art("has a sheet of its bones, joints and limits", function()
    local rig = rig_of { bones = { { "thigh", from = "hip", to = "knee", limits = { -30, 30 } },
      { "shin", from = "knee", to = "ankle" } } }
    local sheet = rig:sheet({}, { size = 2 })
    assert.equal("white", colour_at(sheet, 50, 40)) -- the middle of a joint
    assert.equal("none", colour_at(sheet, 80, 80))
  end)

  with_art("refuses what it does not have, with the line and the nearest name", function()
    local rig = rig_of()
    raised.each {
      ["there is no joint 'kne'; did you mean 'knee'?"] = function()
        rig_of { bones = { { "thigh", from = "hip", to = "kne" } } }
      end,
      ["the artwork has no part 'tigh'; did you mean 'thigh'?"] = function()
        rig_of { bones = { { "leg", from = "hip", to = "knee", parts = { "tigh" } } } }
      end,
      ["bone 'tigh': the artwork has no part of this name; did you mean 'thigh'? Else give it "
        .. "parts = {}"] = function()
        rig_of { bones = { { "tigh", from = "hip", to = "knee" } } }
      end,
      ["bone 'tail' moves nothing: the artwork has no part of this name, and no bone begins at its "
        .. "end. parts = {} says that this is meant"] = function()
        rig_of { bones = { { "tail", from = "hip", to = "knee" } } }
      end,
      ["there is no bone 'hips'"] = function()
        rig_of { bones = { { "thigh", from = "hip", to = "knee", parent = "hips" } } }
      end,
      ["begins where two bones end, 'a' and 'b': name its parent"] = function()
        rig_of { bones = { { "a", from = "hip", to = "knee" }, { "b", from = "hip", to = "knee" },
                           { "shin", from = "knee", to = "ankle" } } }
      end,
      ["is its own parent"] = function()
        rig_of { bones = { { "a", from = "hip", to = "knee", parent = "b" },
                           { "b", from = "knee", to = "hip", parent = "a" } } }
      end,
      ["moves with two bones"] = function()
        rig_of { bones = { { "a", from = "hip", to = "knee", parts = { "shin" } },
                           { "b", from = "knee", to = "ankle", parts = { "shin" } } } }
      end,
      ["has no length"] = function()
        rig_of { bones = { { "a", from = "hip", to = "hip" } } }
      end,
      ["the first limit, 30 degrees, is more than the second, 10"] = function()
        rig_of { bones = { { "a", from = "hip", to = "knee", limits = { 30, 10 } } } }
      end,
      ["the artwork has no parts 'nose A'"] = function() rig_of { switches = { "nose" } } end,
      ["cannot be a bone's name"] = function()
        rig_of { bones = { { "at", from = "hip", to = "knee" } } }
      end,
      ["needs at least one bone"] = function() rig_of { bones = {} } end,
      ["the pose has 'tigh', which is no bone, switch or field; did you mean 'thigh'?"] =
        function() rig:pose { tigh = 3 } end,
      ["field 'rotate' must be a finite number, got nan"] = function()
        rig:pose { thigh = { rotate = 0 / 0 } }
      end,
      ["field 'scale' must be more than 0, got 0"] = function()
        rig:pose { thigh = { scale = 0 } }
      end,
      ["there is no joint 'ancle'; did you mean 'ankle'?"] = function()
        rig:pose { reach = { ancle = { 1, 2 } } }
      end,
      ["reach: no bone ends at the joint 'hip'"] = function()
        rig:pose { reach = { hip = { 1, 2 } } }
      end,
      ["is in two chains that reach"] = function()
        rig:pose { reach = { ankle = { 1, 2 }, knee = { 3, 4 } } }
      end,
      ["names 'tail', which is no part that moves"] = function()
        rig:pose { front = { "tail" } }
      end,
      ["the parts of 'mouth' are A, B, and not 'C'"] = function() rig:pose { mouth = "C" } end,
    }
  end)
end)

describe("a painted puppet", function()
  local function layer(name, x, y, w, h, r, g, b)
    return { name = name, x = x, y = y, w = w, h = h, pixel = function() return r, g, b, 255 end }
  end

  local function painting()
    local bytes = paintings.openraster { w = 100, h = 100, layers = {
      layer("body", 40, 0, 20, 40, 255, 0, 0),
      { name = "leg", layers = { layer("thigh", 45, 36, 10, 28, 0, 255, 0),
                                 layer("shin", 46, 58, 8, 26, 0, 0, 255) } },
      { name = "mouth A", layers = { layer("lips", 44, 4, 4, 4, 255, 255, 255) } },
      layer("mouth B", 52, 4, 4, 4, 255, 255, 255),
      { name = "guides", layers = { layer("joint hip", 48, 38, 4, 4, 0, 0, 0),
                                    layer("joint knee", 48, 58, 4, 4, 0, 0, 0),
                                    layer("joint ankle", 48, 78, 4, 4, 0, 0, 0) } },
    } }
    return assert(layers.read(bench:write("figure.ora", bytes)))
  end

  it("moves its layers, by name and inside of groups", function()
    local rig = puppet { art = painting(), switches = { "mouth" },
      bones = { { "leg", from = "hip", to = "knee" }, { "shin", from = "knee", to = "ankle" } } }
    assert.equal("white", colour_at(rig:pose {}, 46, 6))
    assert.equal("red", colour_at(rig:pose {}, 54, 6))
    assert.equal("blue", colour_at(rig:pose {}, 50, 80)) -- the joint is not drawn
    local object = rig:pose { leg = -90, mouth = "B" }
    assert.equal("green", colour_at(object, 55, 42))
    assert.equal("blue", colour_at(object, 80, 40))
    assert.equal("white", colour_at(object, 54, 6))
    object = rig:pose { leg = -90, shin = 90 }
    assert.equal("blue", colour_at(object, 70, 58))
    near(65, 60, rig:joint({ reach = { ankle = { 65, 60 } } }, "ankle"))
  end)

  it("keeps what is not changed, and refuses what is not there", function()
    local tree = painting()
    local moved = tree:with { ["leg/shin"] = function(shin) return shin:translate(30, 0) end }
    assert.equal("blue", colour_at(moved.object, 80, 80))
    assert.equal("green", colour_at(moved.object, 46.5, 62))
    assert.equal("blue", colour_at(tree.object, 50, 70))
    assert.equal("red", colour_at(tree:show { mouth = "B" }.object, 46, 6))
    raised.each {
      ['layers: there is no layer "leg/chin"; did you mean "leg/shin"?'] = function()
        tree:with { ["leg/chin"] = print }
      end,
      ["layers: layer 'body' must have a function, got number"] = function()
        tree:with { body = 3 }
      end,
      ["layers: the function of layer 'body' must return an object, got nil"] = function()
        tree:with { body = function() end }
      end,
      ["layers: show: the parts of 'mouth' are A, B, and not 'C'"] = function()
        tree:show { mouth = "C" }
      end,
    }
  end)
end)

describe("poses", function()
  with_art("are mixed, layered and mirrored as tables", function()
    local rig = rig_of()
    local p = { ["arm left"] = 10, head = { rotate = 20, scale = 2 }, at = { 10, 0 }, mouth = "A",
                reach = { ["foot L"] = { 60, 90, pole = { 70, 80 } } } }
    local q = { ["arm left"] = { rotate = 30 }, mouth = "B" }
    assert.are.same({ ["arm left"] = { rotate = 20.0 }, head = { rotate = 10.0, scale = 1.5 },
                      at = { 5.0, 0.0 }, mouth = "B",
                      reach = { ["foot L"] = { 60, 90, pole = { 70, 80 } } } }, rig.mix(p, q, 0.5))
    assert.are.same({ a = 3, b = { rotate = 5, scale = 4 }, mouth = "B" },
      rig.layer({ a = 1, b = { scale = 2 } }, { a = 2, b = { rotate = 5, scale = 2 },
                                               mouth = "B" }))
    assert.are.same({ ["arm right"] = -10, head = { rotate = -20, scale = 2 }, at = { -10, 0 },
                      mouth = "A", reach = { ["foot R"] = { 40, 90, pole = { 30, 80 } } } },
      rig.mirror(p))
    assert.are.same(p, rig.mirror(rig.mirror(p)))
  end)

  with_art("mixed at 0 and 1 are the poses themselves", function()
    local rig, random = rig_of(), prng.new(4)
    for _ = 1, 100 do
      local p = { thigh = random:between(-90, 90), shin = random:between(-90, 90) }
      local q = { thigh = { rotate = random:between(-90, 90), stretch = 1.2 }, at = { 3, 4 } }
      near(select(1, rig:joint(p, "ankle")), select(2, rig:joint(p, "ankle")),
        rig:joint(rig.mix(p, q, 0), "ankle"))
      near(select(1, rig:joint(q, "ankle")), select(2, rig:joint(q, "ankle")),
        rig:joint(rig.mix(p, q, 1), "ankle"))
    end
  end)
end)

describe("a tail", function()
  local function still() return {} end

  --- A tail on the knee, at 50, 60.
  local function tail_of(changes)
    local given = { joint = "knee", pose = still, length = 60 }
    for name, value in pairs(changes or {}) do given[name] = value end
    return rig_of():tail(given)
  end

  local function tip_of(tail, time)
    local points = tail:points(time)
    return table.unpack(points[#points])
  end

  with_art("hangs down, or where its angle and the wind leave it", function()
    local points = tail_of():points(3)
    assert.equal(7, #points)
    for k, point in ipairs(points) do near(50, 50 + 10 * k, point[1], point[2]) end
    near(-10, 60, tip_of(tail_of { angle = 180 }, 0))
    near(50, 0, tip_of(tail_of { angle = function() return -90 end, links = 1 }, 0))
    local side = 60 * math.sqrt(0.5)
    near(50 + side, 60 + side, tip_of(tail_of { wind = { 1, 0 } }, 0))
    near(50 - side, 60 + side, tip_of(tail_of { wind = function() return -1, 0 end }, 0))
  end)

  with_art("has links that keep their length, and is a function of the time alone", function()
    local random = prng.new(11)
    local function swaying(time)
      return { thigh = 60 * math.sin(5 * time), at = { 90 * time, 0 } }
    end
    local tail = tail_of { pose = swaying, links = 9, wind = { -0.3, 0 } }
    for _ = 1, 20 do
      local time = random:between(-2, 5)
      local points = tail:points(time)
      near(points[1][1], points[1][2], rig_of():joint(swaying(time), "knee"))
      for k = 2, #points do
        local dx, dy = points[k][1] - points[k - 1][1], points[k][2] - points[k - 1][2]
        assert.is_true(math.abs(math.sqrt(dx * dx + dy * dy) - 60 / 9) < 1e-9)
      end
      assert.same(points, tail:points(time))
    end
  end)

  with_art("streams behind a joint that moves, swings on, and comes to rest", function()
    local tail = tail_of { pose = function(time)
      return { at = { 300 * math.min(0, time), 0 } }
    end }
    assert.is_true(tip_of(tail, -1) < 50 - 300 - 20)
    local farthest = 0
    for i = 0, 24 do farthest = math.max(farthest, (tip_of(tail, i / 24))) end
    assert.is_true(farthest > 60, farthest)
    near(50, 120, tip_of(tail, 9))
  end)

  with_art("refuses what no tail has", function()
    raised.each {
      ["puppet: tail: needs the field 'joint'"] = function()
        rig_of():tail { pose = still, length = 9 }
      end,
      ["puppet: tail: needs the field 'pose'"] = function()
        rig_of():tail { joint = "knee", length = 9 }
      end,
      ["there is no joint 'kne'; did you mean 'knee'?"] = function()
        tail_of { joint = "kne" }:points(0)
      end,
      ["field 'links' must be a whole number from 1 to 100, got 0"] = function()
        tail_of { links = 0 }
      end,
      ["field 'length' must be more than 0, got -1"] = function() tail_of { length = -1 } end,
      ["field 'damping' must be 0.05 to 1, got 0"] = function() tail_of { damping = 0 } end,
      ["field 'stiffness' must be more than 0, got 0"] = function()
        tail_of { stiffness = 0 }
      end,
      ["field 'angle' must be degrees"] = function() tail_of { angle = "down" } end,
      ["field 'wind' must be {x, y}, or a function of the time that returns x, y, got 1, nil"] =
        function() tail_of { wind = function() return 1 end }:points(0) end,
      ["points takes a time, a finite number, got nan"] = function() tail_of():points(0 / 0) end,
    }
  end)
end)

describe("steps", function()
  it("keep a foot on the ground where it is, and swing it on without a jump", function()
    local walk = puppet.steps { stride = 180, period = 0.8, ground = 400, x = 20 }
    local slip, jump, before = 0, 0, nil
    for i = 0, 4000 do
      local time = i / 1000
      local x, y, swing = walk:foot(time, 0.5)
      if before and swing == 0 and before.swing == 0 then
        slip = math.max(slip, math.abs(x - before.x), math.abs(y - before.y))
      end
      if before then jump = math.max(jump, math.abs(x - before.x), math.abs(y - before.y)) end
      before = { x = x, y = y, swing = swing }
    end
    assert.equal(0, slip)
    assert.is_true(jump < 1.2, jump)
    assert.equal(900, walk:body(4))
    local x = walk:foot(0.8 * 0.3) -- the middle of the time on the ground: under the body
    assert.is_true(math.abs(x - (20 + walk:body(0.8 * 0.3))) < 1e-9)
  end)

  it("refuse what no walk has", function()
    for words, settings in pairs {
      ["needs the field 'period'"] = { stride = 1, ground = 1 },
      ["'period' must be more than 0"] = { stride = 1, ground = 1, period = 0 },
      ["'share' must be between 0 and 1"] = { stride = 1, ground = 1, period = 1, share = 1 },
    } do
      local message = raised.message(function() puppet.steps(settings) end)
      assert.is_truthy(message:find(words, 1, true), message)
    end
  end)
end)

-- ---------------------------------------------------------------- motion that follows

describe("a spring", function()
  it("follows a slow movement as a mass on a spring does", function()
    for _, damping in ipairs { 0.1, 0.3, 1 } do
      local spring = motion.spring(math.sin, { frequency = 2, damping = damping })
      local ratio = 1 / (4 * math.pi)
      local size = 1 / math.sqrt((1 - ratio ^ 2) ^ 2 + (2 * damping * ratio) ^ 2)
      local late = math.atan(2 * damping * ratio, 1 - ratio ^ 2)
      for i = 0, 100 do
        assert.is_true(math.abs(spring:at(i / 10) - size * math.sin(i / 10 - late)) < 2e-3)
      end
    end
  end)

  it("swings beyond its end, and a lag does not", function()
    local function jump(time) return time >= 0 and 10 or 0 end
    local spring, lag = motion.spring(jump), motion.lag(jump, 0.2)
    local most, furthest = 0, 0
    for i = -10, 400 do
      most = math.max(most, spring:at(i / 100))
      furthest = math.max(furthest, lag:at(i / 100))
    end
    assert.is_true(most > 12 and most < 15, most)
    assert.is_true(furthest <= 10 + 1e-9 and math.abs(lag:at(0.2) - 6.32) < 0.2)
    assert.equal(0, spring:at(-0.01))
    assert.is_true(math.abs(spring:at(4) - 10) < 0.05)
  end)

  it("moves whole poses", function()
    local hair = motion.spring(function(time)
      return { tip = { rotate = 90 * time }, mouth = "A" }
    end)
    local pose = hair:at(10)
    assert.equal("A", pose.mouth)
    assert.is_true(pose.tip.rotate < 900 and pose.tip.rotate > 880)
  end)

  it("refuses what is no function, and numbers beyond its range", function()
    raised.each {
      ["spring takes a function of the time, got number"] = function() motion.spring(3) end,
      ["'frequency' must be more than 0"] = function()
        motion.spring(math.sin, { frequency = 0 })
      end,
      ["'damping' must be 0.05 to 1"] = function() motion.spring(math.sin, { damping = 0 }) end,
      ["lag takes seconds, a number above 0, got 0"] = function() motion.lag(math.sin, 0) end,
    }
  end)
end)

describe("noise", function()
  it("is smooth, within -1 and 1, and the same for the same seed", function()
    local a, b, other = motion.noise "wind", motion.noise "wind", motion.noise "rain"
    local least, most, step, differs, is_same = 1, -1, 0, false, true
    for i = 1, 20000 do
      local x, y, z = i * 0.37, i * 0.11, i * 0.05
      local value = a(x, y, z)
      is_same = is_same and value == b(x, y, z)
      differs = differs or value ~= other(x, y, z)
      least, most = math.min(least, value), math.max(most, value)
      step = math.max(step, math.abs(a(x + 1e-3, y + 1e-3, z + 1e-3) - value))
    end
    assert.is_true(is_same and differs and least >= -1 and most <= 1 and most - least > 1.5)
    assert.is_true(step < 0.012, step)
  end)

  it("has a value for every number of coordinates, and at every number", function()
    local noise = motion.noise(7)
    assert.equal(noise(3.5), noise(3.5, 0, 0))
    for _, x in ipairs { 1e300, -1e300, 2 ^ 60, math.huge, 0 / 0 } do
      assert.is_true(math.abs(noise(x, x, x)) <= 1)
    end
    assert.is_truthy(raised.message(function() noise("x") end):find "coordinate 1 must be a number")
    assert.is_truthy(raised.message(function() noise() end):find "got none")
  end)
end)

it("staggered movements begin one after another and end together with the whole", function()
  assert.equal(0, motion.stagger(0.3, 3, 3, 0))
  assert.equal(1, motion.stagger(1 / 3, 1, 3, 0))
  for i = 1, 5 do
    assert.equal(0, motion.stagger(0, i, 5))
    assert.is_true(math.abs(motion.stagger(1, i, 5) - 1) < 1e-12)
    assert.equal(0.4, motion.stagger(0.4, i, 5, 1))
  end
end)

-- ---------------------------------------------------------------- particles

--- By id.
local function by_id(list)
  local found = {}
  for _, p in ipairs(list) do found[p.id] = p end
  return found
end

describe("particles", function()
  it("live as long as they should, and as many as are born", function()
    local rain = particles { rate = 100, life = 2 }
    for _, time in ipairs { -3, 0, 1.005, 77.77 } do
      local list = rain:at(time)
      assert.equal(200, #list)
      for i, p in ipairs(list) do
        assert.is_true(p.age >= 0 and p.age < 1 and p.seconds == time - p.id / 100)
        assert.is_true(i == 1 or p.id > list[i - 1].id)
      end
    end
    local burst = particles { rate = 10, life = { 1, 0.5 }, from = 0, to = 1 }
    assert.equal(0, #burst:at(-0.1))
    assert.equal(0, #burst:at(2.6))
    assert.equal(6, #burst:at(0.5))
  end)

  it("move as drag and gravity move them", function()
    for _, drag in ipairs { 0, 1e-9, 0.7, 30 } do
      local source = particles { rate = 7, life = 4, at = { 3, 4, 10, 10 },
        velocity = { 5, -6, 20, 20 }, gravity = { 3, 90 }, drag = drag }
      local before, after = by_id(source:at(10)), by_id(source:at(10 + 1e-5))
      local checked = 0
      for id, p in pairs(before) do
        local q = after[id]
        if q then
          checked = checked + 1
          local vx, vy = (q.x - p.x) / 1e-5, (q.y - p.y) / 1e-5
          assert.is_true(math.abs(vx - p.dx) < 0.02 and math.abs(vy - p.dy) < 0.02)
          local force = (q.dy - p.dy) / 1e-5 - (90 - drag * p.dy)
          assert.is_true(math.abs(force) < 0.5, force)
        end
      end
      assert.is_true(checked >= 27)
    end
  end)

  it("are those of their seed, and go where a field takes them", function()
    local function sum(seed)
      local x = 0
      local source = particles { seed = seed, rate = 50, life = 1, at = { 0, 0, 5, 5 } }
      for _, p in ipairs(source:at(3)) do
        assert.is_true(math.abs(p.x) <= 5 and math.abs(p.y) <= 5)
        x = x + p.x
      end
      return x
    end
    assert.equal(sum "a", sum "a")
    assert.is_true(sum "a" ~= sum "b")
    local list = particles { rate = 5, life = 1,
      field = function(p, time) return p.id, time end }:at(2)
    assert.equal(10, list[#list].x)
    assert.equal(2, list[#list].y)
  end)

  it("refuse what they cannot be", function()
    raised.each {
      ["'rate' must be particles per second, above 0, got nil"] = function()
        particles { life = 1 }
      end,
      ["'life' must be seconds above 0"] = function() particles { rate = 1, life = { 1, 2 } } end,
      ["more than 1000000 at one time"] = function() particles { rate = 1e6, life = 2 } end,
      ["'at' must be {x, y} or {x, y, across, down}, got 3 numbers"] = function()
        particles { rate = 1, life = 1, at = { 1, 2, 3 } }
      end,
      ["field must return x and y, two finite numbers, got nan and nil"] = function()
        particles { rate = 1, life = 1, field = function() return 0 / 0 end }:at(1)
      end,
      ["'drag' must be 0 or more"] = function() particles { rate = 1, life = 1, drag = -1 } end,
    }
    local endless = particles { rate = 1, life = 1 }
    for _, time in ipairs { 1e300, -1e300 } do assert.are.same({}, endless:at(time)) end
  end)
end)

-- ---------------------------------------------------------------- people and animals

describe("a person", function()
  local SVG = '<svg xmlns="http://www.w3.org/2000/svg" width="200" height="300">%s</svg>'
  local LEFT = { torso = "80,60,40,110", Head = "80,0,40,60", arm_l = "70,70,20,70",
    ["left forearm"] = "70,120,20,70", ["Thigh.R"] = "100,160,20,70", ["Shin.R"] = "100,210,20,70",
    ["Foot.R"] = "70,260,50,20" }

  local function drawn(parts)
    local text = {}
    for name, box in pairs(parts) do
      local x, y, w, h = box:match "(%d+),(%d+),(%d+),(%d+)"
      text[#text + 1] = ('<rect id="%s" x="%s" y="%s" width="%s" height="%s"/>'):format(
        name:gsub(" ", "_"), x, y, w, h)
    end
    table.sort(text)
    return svg.load(bench:write("person.svg", SVG:format(table.concat(text))))
  end

  --- The greatest distance of a foot on the ground from where it was set down.
  local function slip(rig, gait, options)
    local worst, down = 0, {}
    for frame = 0, 60 do
      local time = frame / 48
      local pose = puppet[gait](rig, time, options)
      for joint, target in pairs(pose.reach) do
        local x, y = rig:joint(pose, joint)
        x = x + rig:walked(time, options)
        if target.loose then
          down[joint] = nil
        else
          down[joint] = down[joint] or { x, y }
          worst = math.max(worst, math.abs(x - down[joint][1]), math.abs(y - down[joint][2]))
        end
      end
    end
    return worst
  end

  with_art("is found by the names of its parts, of which some may be missing", function()
    local rig = puppet.person { art = drawn(LEFT), bones = { { "hat", from = "neck", to = "crown",
      parent = "head", parts = {} } } }
    local names = {}
    for name, bone in pairs(rig.bones) do
      names[#names + 1] = name .. (bone.parent and " on " .. bone.parent.name or "")
    end
    table.sort(names)
    assert.are.same({ "body", "foot far on shin far", "hat on head", "head on body",
      "lower arm near on upper arm near", "shin far on thigh far", "thigh far on body",
      "upper arm near on body" }, names)
    assert.are.same({ 80, 80 }, rig.joints["shoulder near"])
    assert.are.same({ 110, 270 }, rig.joints["ankle far"])
    assert.are.same({ 80, 270 }, rig.joints["toe far"])
  end)

  with_art("whose foot points to the left walks to the left", function()
    local rig = puppet.person { art = drawn(LEFT) }
    assert.is_true(rig:walked(1) < 0)
    assert.are.equal(-30, rig:walked(1, { stride = 30, pace = 2 }))
    assert.are.same({ -150, 0 }, { rig.bones["shin far"].low, rig.bones["shin far"].high })
  end)

  with_art("sets its feet down where they stay, in every gait", function()
    local child = puppet.person { art = svg.load "../../../scripts/drawings/child.svg",
      switches = { "eye" } }
    assert.is_true(slip(child, "walk") < 1e-9)
    assert.is_true(slip(child, "run", { gait = "run" }) < 1e-9)
    assert.is_true(slip(child, "walk", { stride = 90, pace = 1.3, bounce = 0 }) < 1e-9)
    local fox = puppet.animal { art = layers.load "../../../scripts/paintings/fox.ora" }
    for _, gait in ipairs { "walk", "trot", "gallop" } do
      assert.is_true(slip(fox, gait, { gait = gait }) < 1e-9)
    end
  end)

  with_art("has poses that mix, and keeps its feet where they are drawn", function()
    local child = puppet.person { art = svg.load "../../../scripts/drawings/child.svg" }
    local idle = puppet.idle(child, 0.7)
    local x, y = child:joint(idle, "ankle near")
    assert.is_true(math.abs(x - 150) + math.abs(y - 316) < 1e-9)
    x, y = child:joint(idle, "toe") -- the foot is flat
    assert.is_true(math.abs(x - 180) + math.abs(y - 330) < 1e-9)
    local pose = child.layer(child.mix(puppet.walk(child, 0.2), idle, 0.5),
      puppet.wave(child, 0.2, { side = "left" }))
    assert.is_true(select(2, child:joint(pose, "hand near")) < select(2, child:joint(pose, "neck")))
    assert.are.equal(9, puppet.turn_head(child, 9).head)
    assert.is_truthy(child:pose(pose):bounds())
  end)

  with_art("is refused in sentences", function()
    local rig = puppet.person { art = drawn { body = "0,0,40,90", ["arm_l"] = "0,0,9,40" } }
    raised.each {
      ["puppet: the artwork has no part 'body': person needs one, named body or torso"] = function()
        puppet.person { art = drawn { head = "0,0,40,90" } }
      end,
      ["puppet: write puppet.person { art = ... }, a table"] = function()
        puppet.person(drawn { body = "0,0,40,90" })
      end,
      ["puppet: the person has no legs: parts such as 'thigh near'"] = function()
        puppet.walk(rig, 0)
      end,
      ["puppet: walk takes what puppet.person or puppet.animal returns, got table"] = function()
        puppet.walk({}, 0)
      end,
      ["puppet: walk takes a time, a finite number, got nil"] = function()
        puppet.walk(puppet.person { art = drawn(LEFT) })
      end,
      ["puppet: there is no gait 'galop'; did you mean 'gallop'?"] = function()
        puppet.person { art = drawn(LEFT) }:walked(1, { gait = "galop" })
      end,
      ["puppet: walk: field 'pace' must be more than 0, got 0"] = function()
        puppet.walk(puppet.person { art = drawn(LEFT) }, 1, { pace = 0 })
      end,
      ['puppet: wave: the figure has no arm on the side "far"'] = function()
        puppet.wave(puppet.person { art = drawn(LEFT) }, 1, { side = "far" })
      end,
    }
  end)
end)
