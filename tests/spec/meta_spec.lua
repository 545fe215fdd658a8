-- The annotations for editors name what there is, and nothing else.
local celspan = require "celspan"

local file = assert(io.open "lua/celspan.d.lua")
local text = file:read "a"
file:close()

describe("the annotations", function()
  it("name every function and value of the module", function()
    for name in pairs(celspan) do
      local is_told = text:find("function celspan." .. name .. "(", 1, true)
        or text:find("---@field " .. name .. " ", 1, true)
      assert.is_truthy(is_told, name)
    end
  end)

  it("name nothing that is not there", function()
    for name in text:gmatch "\nfunction celspan%.(%w+)%(" do
      assert.are.equal("function", type(celspan[name]), name)
    end
  end)

  it("name every method", function()
    local union = celspan.union {}
    for name in text:gmatch "\nfunction placed:(%w+)%(" do
      assert.are.equal("function", type(union[name]), name)
    end
    for _, name in ipairs { "translate", "scale", "rotate", "skew", "transform", "quad", "fade",
                            "bounds", "contains", "with" } do
      assert.is_truthy(text:find("function placed:" .. name .. "(", 1, true), name)
    end
  end)
end)
