# Командная строка: справка.
cli-about =
    Открывает клипы скелетной анимации (COLLADA .dae, .zae) и мышцы постоянного объёма (.yaml) в одной сцене.
    Без команды открывает окно, без файла – со встроенным бицепсом.
cli-about-info = Показывает, что содержит файл: узлы, полигональные сетки, клипы, изображения, мышцы, размеры.
cli-about-check = Читает файлы и печатает диагностику: каждую проблему, её строку и то, как программа с ней поступила.
cli-about-render = Рисует изображение (.png), анимацию (.gif, .apng), видео (.mp4, .webm; нужен ffmpeg) или нумерованные изображения; дисплей не нужен.
cli-about-export = Записывает поверхность в заданной позе как .obj (с .mtl), .ply или .stl: мировые координаты, метры, ось Y вверх, треугольники с нормалями.
cli-about-measure = Измеряет мышцы: длина, плечо силы, объём и радиусы при каждом угле в локте.
cli-about-bench = Измеряет скорость растеризатора на этой машине.
cli-about-help = Показывает эту страницу или страницу команды.

cli-heading-usage = Вызов:
cli-heading-commands = Команды
cli-heading-arguments = Аргументы
cli-heading-options = Параметры
cli-heading-output = Результат
cli-heading-time = Время и поза
cli-heading-view = Ракурс
cli-heading-appearance = Отображение
cli-heading-examples = Примеры:
cli-word-options = ПАРАМЕТРЫ
cli-help-closing = Код возврата: 0 – готово, 1 – файл не удалось использовать, 2 – неверный вызов. «-» вместо файла означает стандартный ввод.

cli-arg-files = Файлы, которые откроются рядом в одной сцене
cli-arg-file = Файл: .dae, .zae или .yaml
cli-arg-measure-files = Файлы для измерения; единица длины в них должна быть одна
cli-arg-check-files = Файлы для проверки
cli-arg-render-files = Файлы, которые будут нарисованы рядом в одной сцене
cli-arg-command = Команда, о которой нужна справка
cli-arg-help = Показать эту справку
cli-arg-version = Показать версию
cli-arg-json = Печатать JSON
cli-arg-render-output = Выходной файл: .png, .gif, .apng, .mp4, .webm или шаблон вроде frame-%04d.png – по изображению на кадр, нумерация с 0
cli-arg-export-output = Выходной файл: .obj, .ply или .stl
cli-arg-size = Размер изображения в пикселях; по умолчанию 1280x720
cli-arg-samples = Отсчётов на пиксель: 4 – сглаживание (по умолчанию), 1 – быстрее
cli-arg-background = Цвет фона: #rrggbb, #rgb, название вроде white или none для прозрачного изображения; по умолчанию градиент
cli-arg-threads = Число рабочих потоков; по умолчанию по одному на ядро. Изображение от него не зависит
cli-arg-stats = Вывести в стандартный поток ошибок, сколько миллисекунд занял каждый этап отрисовки (медиана по кадрам)
cli-arg-time = Время в секундах по шкале файла; вне клипа берётся поза на его границе. По умолчанию начало клипа
cli-arg-clip = Клип: имя, id или номер по порядку (#2 – второй клип); по умолчанию первый, а с --time тот, в который попадает это время
cli-arg-angle = Угол в локте в градусах, 0 – прямая рука; для клипа – угол в локте, определённом в его скелете, или в суставе, названном в файле мышц
cli-arg-on-top = Прибавить --angle к движению сустава в клипе, а не заменить его
cli-arg-contraction = Сокращение мышцы, от 0 до 100 процентов
cli-arg-from = Начало анимации в секундах; по умолчанию начало клипа
cli-arg-to = Конец анимации в секундах, включительно; по умолчанию конец клипа
cli-arg-fps = Кадров в секунду, от 0.01 до 1000 (.gif – до 50); по умолчанию 25
cli-arg-camera = Камера: у orbit перспективная проекция, у остальных ортогональная; по умолчанию orbit
cli-arg-yaw = Азимут камеры в градусах вокруг вертикальной оси: 0 – спереди (+Z), 90 – справа (+X); по умолчанию азимут выбранной камеры
cli-arg-pitch = Угол камеры над горизонтом в градусах, от -90 до 90; по умолчанию угол выбранной камеры
cli-arg-zoom = Увеличение относительно вида, в который помещается вся сцена, от 0.01 до 100
cli-arg-turntable = Повернуть модель за время анимации на полный оборот
cli-arg-light = Положение источника света в мировых координатах, метры; по умолчанию слева сверху от камеры
cli-arg-shading = Закраска – где вычисляется освещение: раз на треугольник (flat), в вершинах (gouraud, по умолчанию) или в каждом пикселе (phong)
cli-arg-bones = Рисовать кости
cli-arg-wireframe = Рисовать рёбра треугольников
cli-arg-no-materials = Не учитывать материалы и текстуры
cli-arg-no-skin-follow = Кожу двигает только скелет, мышцы под ней её не приподнимают
cli-arg-no-see-through = Не показывать мышцы сквозь кожу модели
cli-arg-no-normals = Освещать по нормали каждого треугольника, а не по нормалям вершин
cli-arg-angles = Углы в локте в градусах; по умолчанию 0,30,60,90
cli-arg-joint = Сустав, угол которого меняется, по имени в файле мышц; остальные в позе покоя
cli-arg-sweep = Углы в локте от FROM до TO включительно с шагом STEP градусов
cli-arg-compare = Сравнить модель с измеренными радиусами: CSV со столбцом «node» и столбцами deg0, deg30 …
cli-arg-bench-threads = Число рабочих потоков; по умолчанию по одному на ядро
cli-arg-bench-file = Файлы, которые рисовать помимо встроенных сцен
cli-arg-bench-scene = Только сцены, в названии которых есть этот текст
cli-arg-seconds = Наибольшее время на каждую сцену, от 0.01 до 60 секунд; по умолчанию 1
cli-arg-csv = Печатать CSV

cli-example-start = открыть окно со встроенным бицепсом
cli-example-open = открыть клип и мышцу вместе
cli-example-info = что содержит клип
cli-example-info-json = то же для программы, со стандартного ввода
cli-example-check = диагностика всех клипов в папке
cli-example-check-json = то же для программы
cli-example-render = одно изображение в момент 1,5 с, с костями
cli-example-render-gif = весь клип в виде анимации
cli-example-render-sequence = 61 нумерованное изображение, первые две секунды
cli-example-render-turntable = согнутая рука со всех сторон
cli-example-export = полигональная сетка в позе на 1,5 с
cli-example-export-muscle = рука и мышца при 90°
cli-example-measure = таблица для четырёх углов
cli-example-measure-csv = через каждые пять градусов, для электронной таблицы
cli-example-measure-compare = сравнение модели с измеренными радиусами
cli-example-bench = все сцены на всех ядрах
cli-example-bench-threads = то же в одном потоке
cli-example-bench-file = только свой файл, в нескольких размерах
cli-example-help = справка по команде render
cli-usage-error = Вызов не разобран; см. sinew --help.

# Командная строка: что не так в вызове. Печатается после «sinew: ».
cli-option-unknown = Параметра { $option } нет; см. --help.
cli-option-unknown-similar = Параметра { $option } нет; может быть, { $similar }?
cli-option-twice = { $option } можно указать только один раз.
cli-options-contradict = { $one } и { $other } противоречат друг другу; оставьте что-то одно.
cli-argument-too-many = Аргумент «{ $argument }» лишний; см. --help.
cli-argument-missing = Не указано: { $what }; см. --help.
cli-argument-empty = { $what }: имя пустое; укажите имя файла.
cli-stdin-twice = «-» указано несколько раз, а стандартный ввод можно прочесть только один раз.
cli-value-missing = { $option }: не указано значение; см. --help.
cli-value-not-taken = { $option } не принимает значения: «{ $value }» лишнее.
cli-value-not-one-of = { $option }: «{ $value }» не подходит, возможны: { $choices }.
cli-value-wrong = { $option }: «{ $value }» { $why }
cli-value-not-text = Значение параметра – не текст в UTF-8.
cli-value-not-finite = – не конечное число; укажите конечное число.
cli-value-decimal-comma = записано с запятой; нужна точка, например 1.5.
cli-value-not-number = – не число; пишите, например, 1.5.
cli-value-out-of-range = вне пределов от { $low } до { $high }.
cli-value-not-size = – не размер; пишите ШИРИНАxВЫСОТА, например 1280x720, каждая сторона от 1 до { $limit } пикселей.
cli-value-not-point = – не положение; пишите X,Y,Z в метрах, например 1,2.5,-1.
cli-value-not-color = – не цвет; пишите #rrggbb, #rgb, название вроде white или none.
cli-value-not-count = – не число потоков; нужно целое число от 1 до { $limit }.
cli-value-not-angles = – не список углов; пишите градусы, например 0,30,60,90.
cli-value-not-sweep = – не диапазон; пишите FROM:TO:STEP в градусах, например 0:120:5.
cli-value-sweep-empty = не содержит ни одного угла: шаг должен вести от FROM к TO и не быть нулём.
cli-value-sweep-too-fine = содержит слишком мелкий шаг: соседние углы неразличимы; возьмите шаг покрупнее.
cli-value-not-times = – не диапазон времени; пишите FROM:TO:STEP в секундах, например 0:4:0.1.
cli-value-times-empty = не содержит ни одного момента: шаг должен вести от FROM к TO и не быть нулём.
cli-value-too-many-times = даёт больше { $limit } моментов; возьмите шаг покрупнее.
cli-value-times-too-fine = содержит слишком мелкий шаг: соседние моменты неразличимы; возьмите шаг покрупнее.
cli-value-too-many-angles = даёт больше { $limit } углов; возьмите шаг покрупнее.
cli-no-such-command = Команды «{ $name }» нет; см. sinew --help.
cli-no-such-command-similar = Команды «{ $name }» нет; может быть, { $similar }?
cli-command-mistyped = Нет ни файла, ни команды «{ $word }»; может быть, «{ $name }»?
cli-command-unknown = Нет ни файла, ни команды «{ $word }»; см. sinew --help.
cli-no-such-clip = { $file }: клипа «{ $name }» нет; клипы файла: { $names }.
cli-no-clips = { $file }: клипа «{ $name }» нет, в файле нет ни одного клипа.
cli-no-muscle-to-drive = { $file }: мышцы нет, поэтому --contraction ни на что не влияет.
cli-nothing-to-contract = { $file }: ни один сустав не меняет длину мышц, поэтому --contraction ни на что не влияет.
cli-no-arm-to-bend = { $file }: руки нет, поэтому --angle ни на что не влияет; используйте --contraction.
cli-no-elbow-to-bend = { $file }: локоть не найден, поэтому --angle ни на что не влияет; сустав можно назвать в файле мышц, например joint: {"{"}bone: forearm, axis: [1, 0, 0]{"}"}.
cli-no-arm-to-measure = { $file }: мышца не на руке, поэтому угла для измерения нет; уберите --angles и --sweep.
cli-no-arm-to-compare = { $file }: мышца не на руке, поэтому угла для сравнения нет; уберите --compare.
cli-needs-sequence = Для { $option } нужно несколько изображений: пусть OUT оканчивается на .gif, .apng, .mp4 или .webm либо содержит шаблон номера, например frame-%04d.png.
cli-range-empty = --from { $from } позже, чем --to { $to }, поэтому нет кадров, которые можно нарисовать.
cli-range-late = { $file }: анимация заканчивается в { $end } с, поэтому после --from { $from } нет кадров, которые можно нарисовать.
cli-range-early = { $file }: анимация начинается в { $start } с, поэтому до --to { $to } нет кадров, которые можно нарисовать.
cli-too-many-frames = В анимации было бы больше { $limit } кадров; возьмите диапазон короче или меньший --fps.
cli-gif-fps = В .gif не больше { $limit } кадров в секунду; уменьшите --fps или запишите нумерованные изображения.
cli-render-ending = { $out }: имя должно оканчиваться на .png, .gif, .apng, .mp4 или .webm.
cli-ending-alone = { $out } состоит из одного расширения; поставьте перед ним имя.
cli-pattern-twice = { $out }: шаблонов номера два; оставьте один или напишите %% вместо знака процента.
cli-pattern-one-file = { $out }: шаблон номера, такой как %d, нужен для нумерованных изображений, которые sinew render пишет в .png; эта команда пишет один файл, поэтому дайте ему имя без %d.
cli-export-ending = { $out }: имя должно оканчиваться на .obj, .ply или .stl.
cli-out-is-input = { $out } – один из входных файлов; выберите для результата другое имя.

# Командная строка: файлы, которые не удалось использовать, замечания, результаты.
cli-no-window = Эта сборка без окна. Изображение можно получить и без него: sinew render ФАЙЛ -o image.png
cli-window-not-started = Окно не открыть: { $program } не запускается ({ $reason }). Эта программа собирается и устанавливается вместе с sinew.
cli-no-display = Нет дисплея, на котором можно открыть окно. Изображение можно получить и без него: sinew render ФАЙЛ -o image.png
cli-simd-empty = Переменная SINEW_SIMD пуста; задайте в ней набор команд ({ $names }) или удалите её.
cli-simd-unknown = SINEW_SIMD – «{ $name }», такого набора команд Sinew не знает; есть: { $names }.
cli-simd-missing = SINEW_SIMD – «{ $name }», этот процессор такого набора команд не поддерживает; есть: { $names }.
cli-stdout-failed = Стандартный вывод: { $reason }.
cli-angle-held = { $file }: локоть сгибается от { $low }° до { $high }°; угол { $angle }° ограничен этим диапазоном.
cli-export-nothing = Экспортировать нечего: в сцене нет ни сеток с гранями, ни мышц.
cli-check-clean = проблем нет.
cli-measure-beyond = { $file }: сустав сгибается от { $low }° до { $high }°; углы за этими пределами посчитаны без ограничения.
cli-measure-angle = угол, °
cli-measure-length = брюшко, { $unit }
cli-measure-unit-length = с сухожилиями, { $unit }
cli-measure-no-joints = { $file }: ни у одной мышцы нет сустава для измерения, поэтому сустава «{ $joint }» нет; уберите --joint.
cli-measure-unknown-joint = { $file }: сустава «{ $joint }» нет; есть: { $known }.
cli-measure-moment-arm = плечо силы, { $unit }
cli-measure-volume = объём, { $unit }³
cli-measure-error = ошибка объёма
cli-measure-delta = δ
cli-measure-largest = наибольший радиус, { $unit }
cli-unit-mm = мм
cli-unit-cm = см
cli-unit-m = м
cli-unit-in = дюйм
cli-unit-ml = мл
cli-measure-held = длина ограничена допустимым диапазоном мышцы.
cli-bench-scene = сцена
cli-bench-no-scene = Нет сцены, в имени которой есть «{ $text }»; без --scene показаны все сцены.
cli-bench-size = размер
cli-bench-triangles = треугольники
cli-bench-median = медиана, мс
cli-bench-min = наименьшее, мс
cli-bench-pose = поза
cli-bench-vertices = вершины
cli-bench-raster = растеризация
cli-bench-resolve = сведение отсчётов
cli-bench-floor = Нижняя граница, один поток: очистка цвета и глубины { $clear } мс, тест глубины и запись пикселей сферы { $pass } мс, копирование изображения { $copy } мс.
cli-bench-made = Набор команд { $simd }, потоков: { NUMBER($threads, useGrouping: 0) }.
cli-info-file = Файл
cli-info-format = Формат
cli-info-tool = Создан в
cli-info-axis = Вертикальная ось
cli-info-unit = Единица
cli-info-metres = { $value } м
cli-info-nodes = Узлы
cli-info-nodes-value = { NUMBER($nodes, useGrouping: 0) }, из них суставов: { NUMBER($joints, useGrouping: 0) }
cli-info-mesh = Полигональная сетка
cli-info-mesh-value = «{ $name }»: вершин { NUMBER($vertices, useGrouping: 0) }, треугольников { NUMBER($triangles, useGrouping: 0) }
cli-info-mesh-joints = , суставов в скине { NUMBER($joints, useGrouping: 0) }
cli-info-mesh-morphs = , целей морфинга { NUMBER($targets, useGrouping: 0) }
cli-info-clip = Клип
cli-info-clip-value = «{ $name }»: от { $start } с до { $end } с, каналов { NUMBER($channels, useGrouping: 0) }, ключевых кадров { NUMBER($keys, useGrouping: 0) }
cli-info-materials = Материалы
cli-info-image = Изображение
cli-info-image-found = { $uri }
cli-info-image-missing = { $uri } (не найдено)
cli-info-muscle = Мышца
cli-info-muscle-value = «{ $name }»: узлов { NUMBER($nodes, useGrouping: 0) }, длина покоя { $length } { $unit }, объём { $volume } { $unit }³
cli-info-bounds = Ограничивающий параллелепипед
cli-info-bounds-value = от { $min } до { $max } м
cli-info-warnings = Диагностика

# Измеренные радиусы.
cli-table-not-text = Это не текст в UTF-8; измеренные радиусы задаются файлом CSV.
cli-compare-title = { $name }: радиусы в { $unit }, модель и измерения
cli-compare-node = узел
cli-compare-model = { $angle }° модель
cli-compare-measured = измерено
cli-compare-rms = среднекв. разность
cli-compare-volume = объём, { $unit }
cli-compare-ratio = От { $from }° до { $to }° прирост измеренных радиусов в { $ratio } раза больше, чем у модели.
cli-compare-explained = Измеренные радиусы не сохраняют объём: между углами он меняется на { $spread } %, поэтому никакая мышца постоянного объёма не может им соответствовать.

# Запись файлов.
export-not-written = Файл не удалось записать: { $reason }.
export-not-a-file = Это папка или устройство; выберите для результата имя файла.
export-held = Этот файл открыт или относится к открытому документу, и результат никогда его не заменяет; выберите другое имя.
export-too-much = Преобразование этого документа заняло бы больше { NUMBER($limit, useGrouping: 0) } МБ памяти; ничего не записано.
export-too-large = Этот формат допускает не больше { NUMBER($limit, useGrouping: 0) } пикселей по стороне.

cli-about-fit = Создаёт файл мышцы по измеренным радиусам: множители прироста методом наименьших квадратов при постоянном объёме или измеренные позы.
cli-arg-fit-table = Измеренные радиусы: строка «node,deg0,deg30 …» и по строке на каждый узел
cli-arg-fit-output = Выходной файл: мышца (.yaml)
cli-arg-like = Файл мышцы, из которого берутся рука, крепления и единица; по умолчанию измеренный бицепс (OpenArm 2.0)
cli-arg-model = Модель для записи: множители прироста (по умолчанию) или измеренные позы
cli-example-fit = множители прироста на руке измеренного бицепса
cli-example-fit-poses = измеренные позы на другой руке
cli-fit-ending = { $out }: имя файла мышцы оканчивается на .yaml.
cli-like-no-muscle = В этом файле нет мышцы; для --like нужен файл мышцы, чьи рука, крепления и единица перейдут к новой.
cli-fit-source = Подобрано по { $table } при постоянном объёме; среднеквадратичная разность { $rms }.
cli-rms-title = Среднеквадратичная разность с измеренными радиусами, { $unit }, при объёме первого угла:
cli-rms-own = множители прироста из файла
cli-rms-fitted = подобранные множители прироста
cli-rms-poses = измеренные позы
cli-compare-growth = Прирост радиуса от { $from }° до { $to }°, { $unit }
cli-compare-grown-model = модель
cli-compare-times = измерено / модель
cli-about-convert = Записывает всю сцену как glTF 2.0: узлы, скины, морфинг, клипы, материалы, изображения; мышцы – целями морфинга.
cli-arg-convert-output = Выходной файл: .glb (двоичный) или .gltf (текст)
cli-example-convert = клип со скелетом для любой программы, которая читает glTF
cli-example-convert-muscle = рука сгибается, мышца записана целями морфинга
cli-convert-ending = { $out }: имя должно оканчиваться на .glb или .gltf.
gltf-shear = В анимации узла «{ $node }» есть скос, который glTF не поддерживает; она записана без скоса.
gltf-skin-shapes = У кожи над мышцами слишком много вершин или ключевых кадров, чтобы погрешность была меньше 0,5 мм; целей морфинга на сетку: { NUMBER($count, useGrouping: 0) }.
gltf-colours = Клип «{ $clip }» анимирует цвета или источники света; glTF анимирует только узлы и веса целей морфинга, поэтому у цветов и света значения покоя.
gltf-image = Изображения «{ $name }» нет, или его не удалось прочитать; оно не учтено.
gltf-ambient = Свет «{ $name }» – фоновый; в glTF фонового света нет, поэтому он не учтён.
gltf-following-skin = У полигональной сетки «{ $mesh }» есть собственные цели морфинга, и она следует за мышцами; вместе это в glTF не записывается, поэтому сетка записана без следования за мышцами.
gltf-mixed = К полигональной сетке «{ $mesh }» морфинг применяется после скиннинга, чего glTF не поддерживает; она записана в начальной позе.
gltf-moved = Клип «{ $clip }» начинается раньше 0 с, чего glTF не допускает; его ключевые кадры сдвинуты на { NUMBER($milliseconds, useGrouping: 0) } мс.
gltf-shapes = { $count ->
    [0] У мышц слишком много вершин для целей морфинга; они записаны без анимации.
    [one] У мышц слишком много вершин или ключевых кадров, чтобы погрешность была меньше 0,5 мм; на мышцу записано не более { NUMBER($count, useGrouping: 0) } цели морфинга.
    [few] У мышц слишком много вершин или ключевых кадров, чтобы погрешность была меньше 0,5 мм; на мышцу записано не более { NUMBER($count, useGrouping: 0) } целей морфинга.
   *[other] У мышц слишком много вершин или ключевых кадров, чтобы погрешность была меньше 0,5 мм; на мышцу записано не более { NUMBER($count, useGrouping: 0) } целей морфинга.
}
# Анимации, оболочки, вопросы.
cli-about-completions = Печатает сценарий автодополнения команд sinew для оболочки.
cli-arg-shell = Оболочка: bash, zsh или fish
cli-arg-quiet = Сообщать только об ошибках и предупреждениях и ни о чём не спрашивать
cli-arg-verbose = Сообщать и диагностику файлов, и записанные файлы
cli-arg-force = Заменять существующие файлы без вопроса; без терминала вопрос и так не задаётся
cli-arg-scale = Масштаб всего изображения, включая линии: 2 – вдвое больше столбцов и строк
cli-arg-duration = Длительность анимации в секундах вместо --to; по умолчанию для оборота, сгибания и изменения угла или сокращения – 4
cli-arg-sweep-angle = Согнуть локоть от одного угла до другого за время анимации, градусы
cli-arg-sweep-contraction = Сократить мышцу от одного значения до другого за время анимации, проценты
cli-arg-grid = Рисовать координатную сетку
cli-arg-axes = Рисовать мировые оси
cli-arg-bounding-box = Рисовать ограничивающий параллелепипед
cli-arg-lines-of-action = Рисовать линии действия мышц
cli-example-render-sweep = локоть сгибается в трёхсекундной анимации
cli-example-completions = автодополнение bash для текущего пользователя
cli-value-not-span = – не диапазон; пишите FROM:TO, например { $example }.
cli-scale-too-large = С таким --scale сторона длиннее { $limit } пикселей; возьмите меньший масштаб.
cli-progress = Кадр { NUMBER($done, useGrouping: 0) } из { NUMBER($count, useGrouping: 0) }
cli-written = { $out }: записано { NUMBER($count, useGrouping: 0) } { $count ->
        [one] кадр
        [few] кадра
       *[other] кадров
    } размером { $width } × { $height } пикселей.
cli-export-written = { $out }: записано.
cli-ask-overwrite = { $out } уже существует{ $more ->
        [0] {""}
       *[other] , и ещё { NUMBER($more, useGrouping: 0) }
    }. Заменить? [д/Н]
cli-left-alone = файл не заменён.
export-cancelled = Остановлено, ничего не записано.
export-no-ffmpeg = Для этого формата видео нужен ffmpeg, а он не установлен; установите его или выберите .gif, .apng или нумерованные изображения.
export-no-codec = В установленном ffmpeg нет кодировщика для этого формата видео ({ $names }); выберите .gif, .apng или нумерованные изображения.
export-encoder-failed = ffmpeg не смог записать видео: { $reason }

cli-arg-times = Время клипа, который двигает кости, в секундах, вместо углов
cli-example-measure-times = по времени клипа, для электронной таблицы
cli-measure-time = время, с
cli-measure-no-clip = { $file }: клипа нет, поэтому нет времени, по которому можно измерять; уберите --times и --joints.
cli-measure-no-joint-no-clip = В { $file } нет ни сустава, ни клипа, который бы его двигал; уберите --joints.
cli-measure-time-held = { $file }: клип длится от { $start } с до { $end } с; время за его пределами ограничено его концами.
cli-arg-joints = Углы каждого сустава по ходу клипа, 25 раз в секунду или в моменты --times: сгибание между двумя его костями и поворот от позы покоя
cli-example-measure-joints = углы всех суставов по ходу клипа, для электронной таблицы
cli-joints-name = сустав
cli-joints-flexion-least = сгибание от, °
cli-joints-flexion-most = до, °
cli-joints-rotation-least = поворот от позы покоя от, °
cli-joints-rotation-most = до, °
table-no-clip = В этом файле нет анимированного клипа, поэтому измерять по времени нечего.
table-no-muscle = В этом файле нет мышцы, поэтому измерять нечего.
table-no-joint = В этом файле нет суставов, поэтому измерять нечего.
table-too-long = В таблице было бы больше { NUMBER($limit, useGrouping: 0) } строк; возьмите меньше моментов.
cli-arg-plot = Нарисовать кривые в файл .png или .svg; без углов и времени – по градусам или по ходу клипа
cli-arg-plot-scale = Масштаб .png относительно ширины 848 пикселей, от 0.1 до 8; по умолчанию 2
cli-arg-published = Нарисовать только плечо силы каждой мышцы, а за ним – опубликованные для бицепса, трицепса или плечевой мышцы
cli-measure-none-published = В файле «{ $file }» нет мышцы локтя, плечо силы которой опубликовано: с названием «бицепс», «трицепс» или «плечевая».
cli-measure-units-differ = В файлах разные единицы длины; измерьте файлы по одному.
cli-example-measure-published = плечи силы поверх данных Arm26
cli-example-measure-plot = длина, плечо силы, радиус и объём кривыми
cli-plot-ending = { $out }: имя должно оканчиваться на .png или .svg.
plot-flexion = сгибание, °
plot-rotation = поворот от позы покоя, °
plot-some = { $what } ({ NUMBER($shown, useGrouping: 0) } суставов из { NUMBER($all, useGrouping: 0) } с наибольшим размахом)

cli-about-attach = Закрепляет набор мышц из опубликованных моделей на костях фигуры и записывает их в файл мышц.
cli-arg-attach-output = Выходной файл: мышцы (.yaml); клип указан в нём
cli-arg-set = Мышцы рук (Arm26), ног (Gait2392) или и тех и других
cli-arg-side = Стороны тела, на которых будут мышцы; по умолчанию обе
cli-example-attach = мышцы обеих ног
cli-example-attach-side = мышцы левой стороны
cli-attach-several-figures = { $file }: фигур в файле { $count }; мышцы получает первая.
cli-attach-written = { $out }: { $count ->
    [one] записана { $count } мышца
    [few] записаны { $count } мышцы
   *[other] записано { $count } мышц
}.
