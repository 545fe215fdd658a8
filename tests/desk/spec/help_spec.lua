-- What `celspan help WORDS` finds: the words that people bring, and where each leads.
local own = require "tests.support.own"
local manual = own "celspan.manual"
local system = require "tests.support.system"
local workbench = require "tests.support.workbench"

local VERBS = "src/desk/program/verbs/"

local recipes = loadfile(VERBS .. "recipes.lua")(system.read "docs/cookbook.md")
local headings = system.read(workbench.build .. "/src/desk/program/headings.txt")
local synonyms = dofile(VERBS .. "synonyms.lua")
local topics = loadfile(VERBS .. "topics.lua")(recipes, headings, manual.names(), {})

local function finder(rows)
  local find = loadfile(VERBS .. "search.lua")(own "celspan.native".nearest, rows)
  return function(words) return find(topics, words, 3) end
end

local find = finder(synonyms)

--- What is found, each by where to read on, without the beginning that all commands have.
local function places(list)
  local found = {}
  for i, topic in ipairs(list) do found[i] = topic.read:gsub("^celspan help ", "") end
  return found
end

--- A phrase, and what is found for it among the three.
local expected = {
  ["color"] = "lua colour", ["gray"] = 'docs/lua-effects.md, "Grades"', ["tween"] = "lua ease",
  ["keyframes"] = "lua keys", ["keys"] = "lua keys", ["gif"] = 'docs/command-line.md, "Videos"',
  ["mp4"] = 'docs/command-line.md, "Videos"',
  ["how do I make a gif"] = 'docs/command-line.md, "Videos"',
  ["looping gif"] = 'docs/command-line.md, "Videos"', ["prores"] = 'docs/command-line.md, "Videos"',
  ["bone"] = 'docs/guide-puppet.md, "Bones and poses"',
  ["IK"] = 'docs/guide-puppet.md, "Bones and poses"', ["walk"] = 'docs/guide-puppet.md, "A walk"',
  ["walk cycle"] = 'docs/guide-puppet.md, "A walk"', ["puppet"] = 'docs/guide-puppet.md, "Puppets"',
  ["lip sync"] = 'docs/guide.md, "Lip cels"', ["lip"] = "lua lips",
  ["mouth"] = 'docs/guide-shot.md, "The sound and the mouth"',
  ["parallax"] = 'docs/guide.md, "Parallax"', ["parallax scroll"] = 'docs/guide.md, "Parallax"',
  ["blur"] = "lua object:blur", ["motion blur"] = 'docs/guide-picture.md, "Exposures"',
  ["shutter"] = "lua shutter", ["bokeh"] = 'docs/guide-filters.md, "Defocus"',
  ["depth of field"] = 'docs/guide-filters.md, "Defocus"', ["retime"] = "lua cut.retime",
  ["slow motion"] = "lua cut.retime", ["speed ramp"] = "speed_ramp",
  ["time remap"] = "lua cut.retime", ["camera shake"] = "camera_shake",
  ["light rays"] = "light_rays", ["light beam"] = "light_rays", ["waves"] = "water_reflection",
  ["boat"] = "water_reflection", ["film grain"] = "old_film", ["grain"] = "paper_texture",
  ["vignette"] = "soft_vignette", ["chroma key"] = "green_screen",
  ["greenscreen"] = "green_screen", ["luma key"] = "green_screen",
  ["erode"] = "lua matte", ["dilate"] = "lua matte", ["keymix"] = "lua matte",
  ["holdout"] = "lua composite", ["stencil"] = "lua composite", ["keylight"] = "green_screen",
  ["unpremult"] = 'docs/lua-effects.md, "Grades"',
  ["premultiply"] = 'docs/lua-effects.md, "Grades"',
  ["lut"] = 'docs/lua-effects.md, "Grades"',
  ["color grading"] = 'docs/lua-effects.md, "Grades"', ["key"] = "lua keys",
  ["picture in picture"] = "picture_in_picture",
  ["precomp"] = 'docs/guide-picture.md, "A composition inside another"',
  ["lens flare"] = "lua placed:glow",
  ["speech bubble"] = "speech_bubble", ["sprite sheet"] = "sprite_sheet",
  ["rotoscope"] = "rotoscope", ["typewriter"] = "typewriter", ["font"] = "many_scripts",
  ["emoji"] = 'docs/guide.md, "Text"', ["ken burns"] = 'docs/guide.md, "Viewport and camera"',
  ["glitch"] = "glitch_title", ["crop"] = 'docs/guide.md, "Viewport and camera"',
  ["fire"] = "lua particles", ["smoke"] = "lua particles", ["progress bar"] = "rolling_counter",
  ["transition"] = 'docs/guide-film.md, "Transitions"',
  ["onion skin"] = 'docs/command-line.md, "Onion skin"',
  ["psd"] = 'docs/guide.md, "Layered paintings"', ["slurm"] = 'docs/farm.md, "Slurm"',
  ["text on a path"] = "text_on_path", ["shadwo"] = "cast_shadow",
  ["countdown"] = "film_leader", ["timecode burn-in"] = "film_leader",
  ["logo reveal"] = "logo_reveal", ["echo"] = "lua echo", ["auto layout"] = "every_shape",
  ["chromatic aberration"] = "colour_fringes", ["extruded"] = "deep_title",
  ["cel shading"] = "cel_shading", ["chart"] = "lua chart",
  ["river"] = "water_reflection", ["caption pill"] = "srt_subtitles", ["bell"] = "mixed_sound",
  ["sound maker"] = "mixed_sound", ["lantern"] = "neon_glow", ["dashed line"] = "lua stroke",
  ["sway"] = 'docs/guide-puppet.md, "What follows"', ["cloud"] = "lua object:blur",
  ["lattice"] = "lua object:warp", ["feet that do not slide"] = 'docs/guide-puppet.md, "A walk"',
  ["paint fill that closes gaps"] = "lua trace", ["dither"] = "lua dissolve",
  ["HDR out"] = 'docs/formats.md, "Formats"', ["stereo"] = "mixed_sound",
  ["dissolve"] = "lua dissolve",
  ["shape booleans"] = 'docs/guide-picture.md, "Booleans"',
  ["frame rate 29.97"] = 'docs/guide.md, "Film and frames"',
  ["python binding"] = 'docs/c.md, "Other languages"', ["embed in c"] = 'docs/c.md, "Lua inside"',
  ["contexts and memory"] = 'docs/c.md, "Contexts and memory"',
  ["celspan_rostrum_write"] = 'docs/c.md, "The shortest program"',
  ["pull request"] = 'docs/command-line.md, "What changed between two commits"',
  ["ci"] = 'docs/command-line.md, "What changed between two commits"',
  ["visual regression"] = 'docs/command-line.md, "What changed between two commits"',
  ["mp4 too large"] = 'docs/command-line.md, "A video that is too large"',
  ["failed rows"] = 'docs/command-line.md, "Rows that failed"',
  ["accept a new reference"] = 'docs/guide.md, "The animator\'s desk"',
  ["on twos"] = "lua frame:twos", ["pivot"] = 'docs/lua-objects.md, "Places"',
  ["anchor point"] = 'docs/lua-objects.md, "Places"', ["overshoot"] = "lua ease",
  ["evening"] = "time_lapse", ["registration"] = "lua track",
  ["wing"] = 'docs/guide.md, "Drawings"',
  ["paint bucket"] = "lua trace", ["then"] = "lua motion.times", ["9:16"] = "every_shape",
  ["scan"] = 'docs/guide-picture.md, "From scan to character"', ["dolly"] = "lua multiplane",
  ["parralax"] = 'docs/guide.md, "Parallax"', ["xsheet"] = 'docs/guide.md, "Exposure sheets"',
}

--- What compositors and motion designers call things: each phrase leads somewhere.
local designers = {
  "trim path", "repeater", "offset path", "round corners of any path", "zig-zag", "shape booleans",
  "star", "shape morph", "width along a stroke", "gradient along or across a stroke",
  "conic gradient", "mesh gradient", "patterns", "text animators by letter", "text on a path",
  "variable fonts animated", "numbers that count", "captions in", "auto layout", "expressions",
  "wiggle", "spring", "physics", "particles", "keys with easing", "stagger", "audio amplitude",
  "audio spectrum", "time remap", "echo", "motion blur", "posterise time", "track matte alpha",
  "masks", "blend modes", "adjustment layer", "precomposition", "shadow", "directional",
  "lens blur", "light wrap", "displacement map", "turbulence", "grain", "chromatic aberration",
  "halftone", "posterise", "curves", "colour wheels", "OCIO", "HDR out", "keyer", "tracker",
  "rotoscope", "relighting of pictures", "normal-map light", "cast shadow on the ground",
  "multiplane", "3D layers", "depth sort", "extruded", "puppet pins", "lattice", "bones",
  "painted weights", "smart bones", "switches", "physics of hair", "feet that do not slide",
  "lip sync", "exposure sheet", "onion skin", "audio heard while scrubbing",
  "paint fill that closes gaps", "palettes as ids", "boil", "cleanup", "cel shading",
  "ink lines from colour borders", "transitions", "several sounds", "footage", "PSD", "Lottie",
  "Aseprite", "cryptomatte", "GIF", "ProRes 4444", "templates", "stereo", "timecode burn-in",
  "render queue", "colour scripts",
}

describe("the search of help #plain", function() -- in Lua, and in a build as in another
  it("leads from the words of other programs to a recipe, a chapter or a name", function()
    for phrase, place in pairs(expected) do
      local found = table.concat(places(find(phrase)), "\n")
      assert.is_truthy(("\n" .. found .. "\n"):find("\n" .. place .. "\n", 1, true),
        phrase .. " finds " .. found)
    end
  end)

  it("leads on from every word of compositors and motion designers", function()
    for _, phrase in ipairs(designers) do assert.is_true(#find(phrase) > 0, phrase) end
  end)

  it("has synonyms that each lead to something of that title, keyword or name", function()
    local plainly, is_known = finder {}, {}
    for _, row in ipairs(synonyms) do
      assert.is_nil(is_known[row[1]], row[1])
      is_known[row[1]] = true
      for i = 2, #row do
        local first = plainly(row[i])[1]
        local names = first and { first.title, table.unpack(first.keywords or {}) } or {}
        local said = table.concat(names, " "):lower()
        assert.is_truthy(said:find(row[i]:match "%w+$":sub(1, 4), 1, true), row[i])
      end
    end
  end)

  it("prefers the phrase to its words, a title to a keyword, and a keyword to the text", function()
    local rank = loadfile(VERBS .. "search.lua")(function() end, { { "theirs", "ours" } })
    local function titles(words)
      local list = rank({
        { title = "text", text = "soft light" }, { title = "one word", text = "light" },
        { title = "keyword", keywords = { "soft", "light" } }, { title = "light and soft" },
        { title = "a soft light" }, { title = "ours" }, { title = "theirs" },
      }, words, 9)
      for i, entry in ipairs(list) do list[i] = entry.title end
      return list
    end
    assert.same({ "a soft light", "light and soft", "keyword", "text" }, titles "soft lights")
    assert.same({ "theirs", "ours" }, titles "theirs")
    assert.same({}, titles "nothing")
    assert.same({ "light and soft", "a soft light", "keyword" }, titles "the soft unknown")
  end)

  it("finds nothing where nothing is like it", function()
    assert.same({}, find "xyzzyxyzzy")
    assert.same({}, find "")
  end)
end)
