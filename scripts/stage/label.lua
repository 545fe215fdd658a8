--- Words in the middle of a place: the name of a part, in a picture that explains.
return function(words, x, y, colour, size)
  return text { words, x, y, font = "../type/block.ttf", size = size or 20, align = "centre",
    variations = { wght = 560 }, fill = colour or "#1f2a44" }
end
