--- The page of a run as it grows: lines of Markdown, and plots drawn by celspan.
local results = require "tests.bench.results"
local Runner = require "tests.bench.runner"

local Page = {}
Page.__index = Page

--- folder: that of the run; celspan: the program that draws; docs: where the page will be.
function Page.new(folder, celspan, docs)
  return setmetatable({ folder = folder, celspan = celspan, docs = docs, out = {},
                        run = results.read(folder .. "/bench.csv") }, Page)
end

function Page:put(...) self.out[#self.out + 1] = table.concat { ... } end

function Page:cells(list) self:put("| ", table.concat(list, " | "), " |") end

--- The names of the columns of a table.
function Page:head(list)
  self:cells(list)
  self:put("|", ("---|"):rep(#list))
end

--- Which columns after the first `fixed` hold a figure in one of the lines.
local function columns_with_figures(names, lines, fixed)
  local kept = {}
  for i = 1, #names do
    local is_kept = i <= fixed
    for _, line in ipairs(lines) do is_kept = is_kept or line[i] ~= "" end
    if is_kept then kept[#kept + 1] = i end
  end
  return kept
end

--- A title, words and a table: { title =, text =, names =, lines =, fixed = }. The first `fixed`
--- columns, 1 by default, say what a line is about. Lines and columns without a figure are left
--- out, and all of it where no figure is left.
function Page:section(part)
  local fixed, lines = part.fixed or 1, {}
  for _, line in ipairs(part.lines) do
    if table.concat(line, "", fixed + 1) ~= "" then lines[#lines + 1] = line end
  end
  if #lines == 0 then return end
  if part.title then self:put(part.title, "\n") end
  self:put(part.text)
  local kept = columns_with_figures(part.names, lines, fixed)
  local function chosen(list)
    local out = {}
    for i, column in ipairs(kept) do out[i] = list[column] end
    return out
  end
  self:head(chosen(part.names))
  for _, line in ipairs(lines) do self:cells(chosen(line)) end
  self:put ""
end

--- A line of a table: the words of `first`, then text(row) for each column, { name, fields }, whose
--- row has these fields and those of `wanted`.
function Page:line(first, wanted, columns, text)
  local line = { table.unpack(first) }
  for _, column in ipairs(columns) do
    local fields = {}
    for key, value in pairs(wanted) do fields[key] = value end
    for key, value in pairs(column[2]) do fields[key] = value end
    local row = self.run:one(fields)
    line[#line + 1] = row and text(row) or ""
  end
  return line
end

--- The names of columns after those that say what a line is about.
function Page.names(first, columns)
  local names = { table.unpack(first) }
  for _, column in ipairs(columns) do names[#names + 1] = column[1] end
  return names
end

--- A plot of scripts/plot.lua. about: what it shows, for those who do not see it.
function Page:plot(name, about, ...)
  local file = ("%s/pictures/bench-%s.png"):format(self.docs, name)
  assert(os.execute("CELSPAN_PATH='./?.lua' " .. Runner.command(self.celspan, "render",
    "tests/bench/scripts/plot.lua", "--trust", "--progress", "none", "-o", file, "--",
    self.folder .. "/bench.csv", ...)))
  if self.out[#self.out] ~= "" then self:put "" end
  self:put("![", about, "](pictures/bench-", name, ".png)")
  self:put ""
end

function Page:write(path)
  local file = assert(io.open(path, "w"))
  file:write(table.concat(self.out, "\n"), "\n")
  assert(file:close())
end

return Page
