import sys; print("later")
