-- The fenced blocks of a page: what the examples of the documentation are taken from.
local markdown = {}

function markdown.read(path)
  local file = assert(io.open(path, "rb"))
  local text = file:read "a"
  file:close()
  return text
end

--- { { language, text, line, name }, ... }: line is that of the fence; a block whose first line is
--- the comment `-- name.lua` or `-- name.lua: what it shows` has a name.
function markdown.blocks(path)
  local blocks, open, number = {}, nil, 0
  for line in markdown.read(path):gmatch "([^\n]*)\n" do
    number = number + 1
    if open and line == "```" then
      open.text = table.concat(open, "\n") .. "\n"
      open.name = open.text:match "^%-%- (%w[%w_]*)%.lua[:\n]"
      blocks[#blocks + 1] = open
      open = nil
    elseif open then
      open[#open + 1] = line
    elseif line:find "^```" then
      open = { language = line:sub(4), line = number }
    end
  end
  assert(not open, path .. ": a block is not closed")
  return blocks
end

--- The page without its blocks.
function markdown.prose(path)
  return (("\n" .. markdown.read(path)):gsub("\n```.-\n```\n", "\n\n"))
end

return markdown
