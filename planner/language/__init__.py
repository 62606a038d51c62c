"""Read and write human words: folding, identification of the language, orders to stop.

Standard library and ``planner.plan`` alone. Import from the modules: the stop lane must load
neither pydantic nor numpy, so this package's door opens nothing by itself.
"""
