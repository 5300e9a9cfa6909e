# Judges mine.py while it is edited; each screen goes to a file: 1, 2, ...
: > all
COLUMNS=80 rasterproof judge --watch --cases 100 --family half-integer --family design -- python3 -B mine.py > all 2> errors &
judge=$!
shown=0

# Waits for a verdict and puts what has come into a file.
screen() {
    until [ "$(grep -c '^watching' all)" -ge "$1" ]; do sleep 0.1; done
    tail -n +$((shown + 1)) all > "$1"
    shown=$(wc -l < all)
}

screen 1
sed -i 's/bottom - 1/bottom if width > 1 else 0/' mine.py
screen 2
sed -i 's/(ay == by and bx > ax)/(by < ay or ay == by and bx > ax)/' mine.py
screen 3
sed -i 's/bottom if width > 1 else 0/bottom/' mine.py
screen 4
echo 'a mistake of typing' >> mine.py
screen 5
kill -TERM $judge
wait $judge
