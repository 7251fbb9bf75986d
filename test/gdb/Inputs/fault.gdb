continue
backtrace
continue
