-- A conversation of Neovim with the server, from a person's side: what is seen and pressed.

local passed = 0

local function lines()
  return vim.api.nvim_buf_get_lines(0, 0, -1, false)
end

local function text()
  return table.concat(lines(), "\n")
end

local function until_so(what, holds)
  if not vim.wait(20000, holds, 20) then
    error(what .. " does not come")
  end
end

local function put_cursor(piece)
  for row, line in ipairs(lines()) do
    local column = line:find(piece, 1, true)
    if column then
      vim.api.nvim_win_set_cursor(0, { row, column - 1 })
      return
    end
  end
  error(piece .. " is not in the text")
end

local function replace(old, new)
  put_cursor(old)
  local row, column = unpack(vim.api.nvim_win_get_cursor(0))
  vim.api.nvim_buf_set_text(0, row - 1, column, row - 1, column + #old, { new })
end

local function messages()
  return vim.tbl_map(function(it) return it.message end, vim.diagnostic.get(0))
end

local function step(name, run)
  run()
  passed = passed + 1
  print("ok   " .. name .. "\n")
end

local function converse()
  step("the file is not taken for bpftrace", function()
    assert(vim.bo.filetype == "behaviortree", vim.bo.filetype)
    assert(vim.bo.commentstring == "// %s")
  end)

  step("the server is started for it", function()
    until_so("a client", function() return #vim.lsp.get_clients({ bufnr = 0, name = "btc" }) == 1 end)
    until_so("its answer", function() return vim.lsp.get_clients({ bufnr = 0 })[1].initialized end)
    assert(#messages() == 0, vim.inspect(messages()))
  end)

  step("a mistake is shown, and mended by its quick fix", function()
    local sound = text()
    replace("success(goto(A))", "succes(goto(A))")
    until_so("the mistake", function() return #messages() == 1 end)
    assert(messages()[1]:find("`succes` is not declared", 1, true), messages()[1])
    put_cursor("succes(goto(A))")
    vim.lsp.buf.code_action({ apply = true, filter = function(action) return action.title:find("success", 1, true) ~= nil end })
    until_so("the fix", function() return text() == sound end)
    until_so("peace", function() return #messages() == 0 end)
  end)

  step("a predicate is renamed wherever it stands", function()
    put_cursor("battery_low")
    vim.lsp.buf.rename("nearly_empty")
    until_so("the new name", function() return text():find("predicate nearly_empty", 1, true) ~= nil end)
    assert(not text():find("battery_low", 1, true))
    assert(select(2, text():gsub("nearly_empty", "")) > 2)
  end)

  step("hover says what a name means", function()
    put_cursor("nearly_empty")
    local client = vim.lsp.get_clients({ bufnr = 0 })[1]
    local params = vim.lsp.util.make_position_params(0, client.offset_encoding)
    local answer = client:request_sync("textDocument/hover", params, 10000, 0)
    assert(answer.result.contents.value:find("battery <= 25%", 1, true), vim.inspect(answer))
  end)

  step("completion knows what can be chosen", function()
    put_cursor("dock(C)")
    local client = vim.lsp.get_clients({ bufnr = 0 })[1]
    local params = vim.lsp.util.make_position_params(0, client.offset_encoding)
    local answer = client:request_sync("textDocument/completion", params, 10000, 0)
    local labels = vim.tbl_map(function(item) return item.label end, answer.result.items or answer.result)
    assert(vim.iter(labels):any(function(label) return label:find("follow_wall", 1, true) end), vim.inspect(labels))
  end)

  step("the text is laid out", function()
    -- The new name is longer, so what stands in columns moves.
    vim.lsp.buf.format()
    local laid_out = text()
    replace("    choose", "  choose ")
    assert(text() ~= laid_out)
    vim.lsp.buf.format()
    assert(text() == laid_out)
  end)

  step("a tree is offered to be shown, and shown", function()
    local opened
    vim.ui.open = function(path) opened = path end
    put_cursor("tree expert")
    vim.lsp.codelens.refresh({ bufnr = 0 })
    local row = vim.api.nvim_win_get_cursor(0)[1] - 1
    local function here()
      return vim.tbl_filter(function(lens) return lens.range.start.line == row end, vim.lsp.codelens.get(0))
    end
    until_so("an offer", function() return #here() == 2 end)
    vim.ui.select = function(offers, options, chosen)
      for at, offer in ipairs(offers) do
        if options.format_item(offer):find("Show tree", 1, true) then
          return chosen(offer, at)
        end
      end
    end
    vim.lsp.codelens.run()
    until_so("the picture", function() return opened ~= nil end)
    local svg = table.concat(vim.fn.readfile(opened), "\n")
    assert(svg:find("<title>behaviour tree expert</title>", 1, true), svg:sub(1, 200))
    assert(svg:find("nearly_empty", 1, true))
  end)

  step("tree-sitter reads and colours the file", function()
    local parser = vim.treesitter.get_parser(0, "behaviortree")
    assert(not parser:parse()[1]:root():has_error())
    put_cursor("tree expert")
    local captures = vim.treesitter.get_captures_at_cursor(0)
    assert(vim.tbl_contains(captures, "keyword"), vim.inspect(captures))
    assert(vim.treesitter.query.get("behaviortree", "folds"))
  end)

  step("the server ends with the editor", function()
    local client = vim.lsp.get_clients({ bufnr = 0 })[1]
    client:stop()
    until_so("its end", function() return client:is_stopped() end)
  end)
end

local well, why = xpcall(converse, debug.traceback)
if not well then
  print("FAILED: " .. why .. "\n")
  vim.cmd("cquit 1")
end
print(("%d passed, 0 failed\n"):format(passed))
vim.cmd("qall!")
