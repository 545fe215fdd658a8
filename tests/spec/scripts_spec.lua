-- The scripts that ship: each makes a picture on its first, middle and last frame, and the same one
-- again, alone or in company, with one worker or two.

local BINARY = os.getenv("CELSPAN") or "build/celspan"
local WIDTH, HEIGHT = 96, 54

local function run(arguments)
  local pipe = assert(io.popen(("%s %s"):format(BINARY, arguments), "r"))
  local text = pipe:read("a")
  return pipe:close() and text
end

--- A script as an argument. Those of the paper's figures read the font and the pictures beside their
--- folder.
local function quoted(path)
  return ("'%s'%s"):format(path, path:find "/paper/" and " --allow scripts" or "")
end

--- Frames as bytes, RGBA, 8 bits each; nil when the command failed.
local function render(script, frames, workers)
  return run(("render %s -o - --frames %s --size %dx%d --workers %d --progress none")
    :format(quoted(script), frames, WIDTH, HEIGHT, workers))
end

local function colours(frame)
  local seen, count = {}, 0
  for i = 1, #frame, 4 do
    local colour = frame:sub(i, i + 3)
    if not seen[colour] then seen[colour], count = true, count + 1 end
  end
  return count
end

local function scripts()
  local paths = {}
  local list = assert(io.popen("ls scripts/*.lua scripts/paper/figure*.lua"))
  for path in list:lines() do paths[#paths + 1] = path end
  list:close()
  return paths
end

-- Built without OpenImageIO, there are no pictures to read.
local has_pictures = not run("convert no-such.png no-such-either.png 2>&1; true")
  :find("celspan-picture.so", 1, true)

-- Built without the libraries for type and XML, there are no letters, drawings and paintings.
local has_art = not run("check scripts/title.lua 2>&1; true"):find("celspan-art.so", 1, true)

--- A script, and what is in the folder of its name.
local function text_of(path)
  local pipe = assert(io.popen(("cat %s $(find %s -name '*.lua' 2>/dev/null)"):format(path,
    path:gsub("%.lua$", ""))))
  local text = pipe:read("a")
  pipe:close()
  return text
end

--- Whether a script needs a module that is not there.
local function lacks_module(path)
  local text = text_of(path)
  local function calls(...)
    for _, name in ipairs { ... } do
      if text:find("celspan." .. name, 1, true) then return true end
    end
  end
  if path:find "/paper/" then return not (has_pictures and has_art) end
  return calls("image", "picture") and not has_pictures
    or calls("text", "glyphs", "layers", "svg") and not has_art
end

describe("the scripts that ship", function()
  it("are the demo and one for each feature", function()
    assert.is_true(#scripts() >= 15)
  end)

  for _, path in ipairs(scripts()) do
    local test = lacks_module(path) and pending or it

    test(path .. " makes pictures, the same whenever it is asked", function()
      local count = tonumber(assert(run("info " .. quoted(path))):match("frames%s+(%d+)"))
      local size = WIDTH * HEIGHT * 4
      local asked = count < 3 and ("1-%d"):format(count) or ("1,%d,%d"):format((count + 1) // 2, count)
      local bytes = assert(render(path, asked, 1))
      assert.are.equal(math.min(count, 3) * size, #bytes)
      for n = 0, #bytes // size - 1 do
        assert.is_true(colours(bytes:sub(n * size + 1, (n + 1) * size)) >= 5, "frame is blank")
      end
      assert.is_true(bytes == render(path, asked, 2), "another picture with two workers")
      assert.is_true(bytes:sub(-size) == render(path, count, 1), "another picture when alone")
    end)

    test(path .. " has a frame function that is pure", function()
      assert.is_truthy(run("check " .. quoted(path)))
    end)
  end
end)
