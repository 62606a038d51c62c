"""Own the wheels: decide one wheel command every 10 ms. Imports wire only, not numpy."""
