-- The fenced blocks of a page: the source of the documentation's examples.
local system = require "tests.support.system"

local markdown = {}

function markdown.read(path) return assert(system.read(path)) end

--- { { language, text, line, name, file }, ... }: line is that of the fence; a block whose first
--- line is the comment `-- name.lua` or `-- name.lua: what it shows` has a name; file: the name to
--- save it under, which is that name with ".lua", or the one in backquotes before a colon right
--- above the block. options: of `celspan render`, if that first line is a command with
--- --allow-system-fonts.
function markdown.blocks(path)
  local blocks, open, number, above = {}, nil, 0, ""
  for line in markdown.read(path):gmatch "([^\n]*)\n" do
    number = number + 1
    if open and line == "```" then
      open.text = table.concat(open, "\n") .. "\n"
      open.name = open.text:match "^%-%- (%w[%w_]*)%.lua[:\n]"
      open.options = open.text:match "^%-%- [^\n]*(%-%-allow%-system%-fonts)" or ""
      open.file = open.name and open.name .. ".lua" or above:match "`([%w_.-]+)`:$"
      blocks[#blocks + 1] = open
      open, above = nil, ""
    elseif open then
      open[#open + 1] = line
    elseif line:find "^```" then
      open = { language = line:sub(4), line = number }
    elseif line ~= "" then
      above = line
    end
  end
  assert(not open, path .. ": a block is not closed")
  return blocks
end

--- Saves the blocks of a page that have a file into a folder. keeps: a function that selects
--- blocks.
function markdown.save(path, folder, keeps)
  for _, block in ipairs(markdown.blocks(path)) do
    if block.file and keeps(block) then
      system.write(folder .. "/" .. block.file, block.text)
    end
  end
end

--- The text of a page without its blocks.
function markdown.prose(path)
  return (("\n" .. markdown.read(path)):gsub("\n```.-\n```\n", "\n\n"))
end

return markdown
