" `.bt` would be taken for bpftrace. `set` and not `setfiletype`, for Vim has decided before.
autocmd BufRead,BufNewFile *.bt set filetype=behaviortree
